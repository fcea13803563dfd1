#include "transport/techniques/shadow_ray.h"

#include <algorithm>

#include "transport/budget/faint_chance.h"
#include "transport/vertex/surface_vertex.h"
#include "volume/coarse.h"

namespace tyndall {
namespace {

constexpr float kDeepest = 8;  ///< beyond the optical depth at which the least faint_chance is reached, 7.1

/// (1 + depth/8)^-8: with a longer tail than e^-depth, as the depth is a guess.
float guessed_transmittance(float depth) {
  const float step = 1 + depth / 8, squared = step * step, fourth = squared * squared;
  return 1 / (fourth * fourth);
}

/// By the media that hold the ray's origin, as far as they reach. Not for single scattering, whose noise nothing else hides.
float chance_of_tracing(const LightContext& context, const MediaState& media, const Ray& ray, float distance) {
  if (is_single_scattering(context)) return 1;
  const auto& groups = context.world.geometry.groups();
  const ActiveMedia around = media.active(groups, context.world.media);
  if (around.empty()) return 1;
  const float end = std::min(distance, exit_distance(media.bounds(groups), ray));
  const MediaView there{around.data(), around.size()};
  const float clearest = clearest_channel(there);
  if (!(clearest > 0)) return 1;
  const float depth = clearest * nearby_optical_depth(there, ray, end, kDeepest / clearest);
  return faint_chance(guessed_transmittance(depth));
}

/// Of a shadow ray that surfaces stop, from where `media` are: what passes if all of them are panes, as many at most as the
/// path may still pass. Lights that rays cannot find are not seen through any, as in pbrt.
Rgb through_panes(const LightContext& context, MediaState media, Ray ray, const LightSample& light, Sampler& sampler) {
  const BuiltWorld& world = context.world;
  if (!world.has_panes || light.delta || light.volume) return {};
  Rgb T(1.0f);
  float left = light.distance;
  for (int panes = context.settings.max_depth - context.bounce - 1;; --panes) {
    ++context.counters.shadow_rays;
    Trace trace = world.geometry.trace(ray, 0, left * kShadowEnd);
    if (!trace.hit) trace.t_end = left;
    T *= transmittance_to_end(context, ray, trace, media, sampler);
    if (!trace.hit || is_black(T)) return T;
    const auto behind = panes > 0 ? behind_pane(world, ray, *trace.hit, media) : std::nullopt;
    if (!behind) return {};
    T *= behind->unbent;
    left -= trace.hit->t;
    media = behind->media;
    ray = behind->ray;
  }
}

/// How many of the groups that hold a point bring the medium whose emission the light is.
float times_present(const BuiltWorld& world, LightId light, const MediaState& there) {
  const ActiveMedia media = there.active(world.geometry.groups(), world.media);
  return static_cast<float>(std::count(media.begin(), media.end(), &world.volume_lights.medium(light)));
}

}  // namespace

Rgb transmittance_along(const LightContext& context, SpanWalk& walk, const Ray& ray, Rng& rng) {
  Rgb T(1.0f);
  while (const auto i = walk.next()) {
    T *= transmittance(shadow_method(context), i->view(), ray, i->t0, i->t1, rng, context.counters.tracking);
    if (is_black(T)) break;
  }
  return T;
}

Rgb transmittance_to_end(const LightContext& context, const Ray& ray, const Trace& trace, MediaState& media, Sampler& sampler) {
  if (!context.world.has_media()) return Rgb(1.0f);
  Rng rng = sampler.stream();
  SpanWalk walk(context.world.media_context(), media, trace.crossings, trace.t_end);
  const Rgb T = transmittance_along(context, walk, ray, rng);
  context.counters.parity_errors += walk.parity_errors();
  media = walk.state();
  return T;
}

std::optional<LightSample> sample_light(const LightContext& context, LightId light, Vec3 p, Vec2 u) {
  const BuiltWorld& world = context.world;
  if (!world.volume_lights.holds(light)) return world.lights.sample(light, p, u);
  // A ray that is scattered here would pass emission after the last bounce, where none counts.
  return is_last_bounce(context) ? std::nullopt : world.volume_lights.sample(light, p, u);
}

Rgb arriving(const LightContext& context, const MediaState& media, Vec3 origin, const LightSample& light, Sampler& sampler) {
  const BuiltWorld& world = context.world;
  const Ray ray{origin, light.wi};
  const float end = light.volume ? light.distance : light.distance * kShadowEnd;
  if (!world.has_media()) {
    ++context.counters.shadow_rays;
    if (!world.geometry.occluded(ray, 0, end)) return Rgb(1.0f);
    return through_panes(context, media, ray, light, sampler);
  }
  Rng rng = sampler.stream();
  const float chance = chance_of_tracing(context, media, ray, light.distance);
  if (chance < 1 && rng.uniform() >= chance) return {};
  ++context.counters.shadow_rays;
  const auto crossings = world.geometry.trace_shadow(ray, 0, end);
  if (!crossings) return through_panes(context, media, ray, light, sampler) * (1 / chance);

  // Through media the whole distance counts: at optical depth 4 the last 1e-4 of it is 4e-4 of the light.
  SpanWalk walk(world.media_context(), media, *crossings, light.distance);
  Rgb T = transmittance_along(context, walk, ray, rng);
  context.counters.parity_errors += walk.parity_errors();
  if (light.volume && !is_black(T)) T *= times_present(world, *light.volume, walk.state());
  return T * (1 / chance);
}

}  // namespace tyndall
