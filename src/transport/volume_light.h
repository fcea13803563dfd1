/// Next-event estimation toward media that emit.
///
/// A brick that emits is chosen as any light is; a point in it gives a direction. The estimate is then the line integral of
/// emission along the whole ray, up to the first surface [Simon et al. 2017], divided by the density of that direction over all
/// bricks: p(w) = sum over the bricks b on the ray of n pmf(b) int p_V t^2 dt.
#pragma once

#include <optional>

#include "transport/light_context.h"

namespace tyndall {

/// Whether volume emission is sampled by next-event estimation, and scattered rays that pass it are weighted by MIS.
inline bool seeks_volume_lights(const LightContext& context) {
  return !context.world.volume_lights.empty() && context.settings.emission == EmissionStrategy::lights;
}

/// 1/sr: density of next-event estimation for volume emission from `p` along `w`. `Search` has a query, and the cut made for
/// it.
template <typename Search>
float volume_density(const LightContext& context, const Search& search, const VolumesOnRay& volumes) {
  float sum = 0;
  for (const VolumeOnRay& f : volumes) sum += context.selector.n_pmf(search.cut, search.query, f.light) * f.direction;
  return sum;
}

/// A direction from `p` toward volume emission at a point of the light. Its density, times `n_pmf` (n * pmf of this light), is
/// that of the direction over all lights; its radiance is without media in between, for choosing.
template <typename Search>
std::optional<LightSample> sample_volume(const LightContext& context, const Search& search, LightCandidate candidate, Vec3 p,
                                         Vec2 u) {
  if (!seeks_volume_lights(context) || is_last_bounce(context)) return std::nullopt;
  const Vec3 wi = context.world.volume_lights.sample(candidate.light, p, u);
  const VolumesOnRay volumes = context.world.volume_lights.along({p, wi});
  float radiance = 0;
  for (const VolumeOnRay& f : volumes) radiance += f.radiance;
  const float density = volume_density(context, search, volumes);
  if (!(radiance > 0) || !(density > 0)) return std::nullopt;
  return LightSample{
      .wi = wi, .distance = kInfinity, .L = Rgb(radiance), .pdf = density / candidate.n_pmf, .delta = false, .volume = true};
}

/// As Lights::sample, for all kinds of light.
template <typename Search>
std::optional<LightSample> sample_light(const LightContext& context, const Search& search, LightCandidate candidate, Vec3 p,
                                        Vec2 u) {
  if (context.world.volume_lights.holds(candidate.light)) return sample_volume(context, search, candidate, p, u);
  return context.world.lights.sample(candidate.light, p, u, true);
}

/// Light that media emit along a ray up to the first surface, attenuated on the way.
Rgb line_emission(const LightContext& context, const MediaState& media, const Ray& ray, Sampler& sampler);

/// What arrives of `light.L` from `light` at `origin`: visibility, or the line integral in place of the approximation.
Rgb arriving(const LightContext& context, const MediaState& media, Vec3 origin, const LightSample& light, Sampler& sampler);

}  // namespace tyndall
