#include "transport/volume_light.h"

#include <algorithm>

#include "transport/direct_light.h"
#include "transport/media/span_walk.h"

namespace tyndall {

Rgb line_emission(const LightContext& context, const MediaState& media, const Ray& ray, Sampler& sampler) {
  const BuiltWorld& world = context.world;
  ++context.counters.shadow_rays;
  const Trace trace = world.geometry.trace(ray, 0, kInfinity);
  Rng rng = sampler.stream();
  Rgb T{1.0f}, sum;
  SpanWalk walk(world.media_context(), media, trace.crossings, trace.t_end);
  while (const auto interval = walk.next()) {
    const MediaView view(interval->media.data(), interval->media.size());
    const bool glows = std::any_of(view.begin(), view.end(), [](const ParticipatingMedium* m) { return m->emissive(); });
    if (glows) {
      const auto passed = emission_and_transmittance(view, ray, interval->t0, interval->t1, rng, context.counters.tracking);
      sum += T * passed.emitted;
      T *= passed.transmittance;
    } else {
      T *= transmittance(shadow_method(context), view, ray, interval->t0, interval->t1, rng, context.counters.tracking);
    }
    if (is_black(T)) break;
  }
  context.counters.parity_errors += static_cast<std::uint64_t>(walk.parity_errors());
  return sum;
}

Rgb arriving(const LightContext& context, const MediaState& media, Vec3 origin, const LightSample& light, Sampler& sampler) {
  if (light.volume) return line_emission(context, media, {origin, light.wi}, sampler) * (1 / light.L.r);
  return visibility(context, media, origin, light.wi, light.distance, sampler);
}

}  // namespace tyndall
