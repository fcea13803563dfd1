#include "transport/pixel/directly_visible.h"

#include <cmath>

#include "transport/techniques/shadow_ray.h"
#include "volume/coarse.h"

namespace tyndall {
namespace {

SpanWalk walk_to(const BuiltWorld& world, const Ray& ray, const Trace& trace) {
  return SpanWalk(world.media_context(), world.media_at_start(ray.o), trace.crossings, trace.t_end);
}

}  // namespace

std::optional<DirectlyVisible> directly_visible(const BuiltWorld& world, const Ray& ray) {
  // Traced as the path's own ray is, not as a shadow ray, which ends before the light: the glass of a distant bulb, as close to
  // it as that, hides it.
  Trace trace = world.geometry.trace(ray, 0, kInfinity);
  const auto id = trace.hit ? world.light_of(*trace.hit) : std::nullopt;
  if (!id) return std::nullopt;
  const EmitterHit hit = emitter_hit(*trace.hit);
  const Rgb L = world.lights.emitted(*id, hit, -ray.d);
  if (is_black(L)) return std::nullopt;
  return DirectlyVisible{*id, hit, L, std::move(trace)};
}

Rgb attenuated(const LightContext& context, const Ray& ray, const DirectlyVisible& seen, Sampler& sampler) {
  MediaState media = context.world.media_at_start(ray.o);
  return transmittance_to_end(context, ray, seen.trace, media, sampler);
}

float attenuated_roughly(const BuiltWorld& world, const Ray& ray, const DirectlyVisible& seen) {
  if (!world.has_media()) return 1;
  float depth = 0;
  SpanWalk walk = walk_to(world, ray, seen.trace);
  while (const auto i = walk.next()) depth += coarse_optical_depth(i->view(), ray, i->t0, i->t1);
  return depth < kDeepestSeen ? std::exp(-depth) : 0.0f;
}

}  // namespace tyndall
