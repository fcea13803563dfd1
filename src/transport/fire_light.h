/// Next-event estimation toward glowing media.
///
/// A brick that emits is chosen as any light is; a point in it gives a direction. What counts is then the line integral of
/// emission along the whole ray, up to the first surface [Simon et al. 2017], divided by the density of that direction,
/// by whichever brick it could have been found: p(w) = sum over the bricks on the ray of tries(b) int p_V t^2 dt.
#pragma once

#include <optional>

#include "transport/light_context.h"

namespace tyndall {

/// Whether glowing media are sought as lights, and so what a scattered ray gathers in them shares its weight.
inline bool seeks_fire(const LightContext& context) {
  return !context.world.fire.empty() && context.settings.emission == EmissionStrategy::lights;
}

/// 1/sr: how densely next-event estimation looks from `p` along `w` for fire. `Search` has a query, and the cut made for it.
template <typename Search>
float fire_density(const LightContext& context, const Search& search, const FiresOnRay& fires) {
  float sum = 0;
  for (const FireOnRay& f : fires) sum += context.selector.expected(search.cut, search.query, f.light) * f.direction;
  return sum;
}

/// Fire on the way from `p` toward a point of the light. Its density, times `tries` (of this light, on average), is that of
/// the direction by all the lights; its radiance is a guess without media in between, for choosing.
template <typename Search>
std::optional<LightSample> sample_fire(const LightContext& context, const Search& search, LightCandidate tried, Vec3 p,
                                       Vec2 u) {
  if (!seeks_fire(context) || is_last_event(context)) return std::nullopt;
  const Vec3 wi = context.world.fire.sample(tried.light, p, u);
  const FiresOnRay fires = context.world.fire.along({p, wi});
  float glow = 0;
  for (const FireOnRay& f : fires) glow += f.glow;
  const float density = fire_density(context, search, fires);
  if (!(glow > 0) || !(density > 0)) return std::nullopt;
  return LightSample{
      .wi = wi, .distance = kInfinity, .L = Rgb(glow), .pdf = density / tried.tries, .delta = false, .volume = true};
}

/// As Lights::sample, for all kinds of light.
template <typename Search>
std::optional<LightSample> sample_light(const LightContext& context, const Search& search, LightCandidate tried, Vec3 p,
                                        Vec2 u) {
  if (context.world.fire.holds(tried.light)) return sample_fire(context, search, tried, p, u);
  return context.world.lights.sample(tried.light, p, u, true);
}

/// Light that media emit along a ray up to the first surface, dimmed on the way.
Rgb line_emission(const LightContext& context, const MediaState& media, const Ray& ray, Sampler& sampler);

/// What arrives of `light.L` from `light` at `origin`: visibility, or what the line holds in place of the guess.
Rgb arriving(const LightContext& context, const MediaState& media, Vec3 origin, const LightSample& light, Sampler& sampler);

}  // namespace tyndall
