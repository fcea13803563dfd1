#include "transport/techniques/way.h"

#include "transport/media/scattering.h"
#include "transport/media/span_walk.h"
#include "transport/techniques/direct_light.h"

namespace tyndall {

Rgb in_scattered(const LightContext& context, const Way& way, LightId point, Sampler& sampler) {
  const BuiltWorld& world = context.world;
  const Vec3 p = way.ray.at(way.t), wo = -way.ray.d;
  const auto light = world.lights.sample(point, p, {}, true);
  if (!light || is_black(light->L)) return {};
  ++context.counters.shadow_rays;
  const auto crossings = world.geometry.trace_shadow(way.ray, 0, way.t);
  if (!crossings) return {};

  SpanWalk to_end(world.media_context(), way.start, *crossings, way.t);
  while (to_end.next()) {
  }
  context.counters.parity_errors += to_end.parity_errors();
  const MediaState there = to_end.state();
  const Scattering scattering = Scattering::at(there.active(world.geometry.groups(), world.media), p);
  if (is_black(scattering.sigma_s)) return {};

  Rng rng = sampler.stream();
  SpanWalk walk(world.media_context(), way.start, *crossings, way.t);
  const Rgb T = transmittance_along(context, walk, way.ray, rng);
  if (is_black(T)) return {};
  const Rgb intensity = light->L * light->distance * light->distance;
  return scattering.sigma_s * scattering.phase.eval(wo, light->wi) * intensity * T *
         arriving(context, there, p, *light, sampler);
}

}  // namespace tyndall
