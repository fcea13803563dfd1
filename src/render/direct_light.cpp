#include "render/direct_light.h"

namespace tyndall {
namespace {

/// Shadow rays end this fraction short of the light, so that they do not meet the emitter itself.
constexpr float kShadowEnd = 1 - 1e-4f;

/// One light's contribution, divided by the probability `pmf` of having chosen it.
Rgb sample_light(const LightContext& context, const Vertex& vertex, Rgb beta, SelectedLight selected) {
  const auto light = context.world.lights.sample(selected.light, vertex.p(), context.sampler.next_2d(), true);
  if (!light || is_black(light->L) || !(light->pdf > 0)) return {};
  const float density = selected.pmf * light->pdf;
  if (!(density > 0)) return {};
  const Rgb f = vertex.eval(light->wi);
  if (is_black(f)) return {};

  const Vec3 origin = vertex.origin(context.world.geometry, light->wi);
  const Rgb T = visibility(context, vertex.media_toward(context.world.geometry, light->wi), origin, light->wi, light->distance);
  if (is_black(T)) return {};
  const float weight = light->delta ? 1.0f : mis_weight(density, vertex.pdf(light->wi, beta));
  return f * light->L * T * (weight / density);
}

}  // namespace

Rgb visibility(const LightContext& context, const MediaState& media, Vec3 origin, Vec3 wi, float distance) {
  const World::Parts& world = context.world;
  const float t_end = distance * kShadowEnd;
  ++context.counters.shadow_rays;
  const Ray ray{origin, wi};
  const auto crossings = world.geometry.trace_shadow(ray, 0, t_end);
  if (!crossings) return {};
  Rgb T{1.0f};
  if (!world.has_media()) return T;

  Rng rng = context.sampler.stream();
  SpanWalk walk(world.media_context(), media, *crossings, t_end);
  while (const auto interval = walk.next()) {
    const MediaView view(interval->media.data(), interval->media.size());
    T *= transmittance(context.transmittance, view, ray, interval->t0, interval->t1, rng, context.counters.tracking);
    if (is_black(T)) break;
  }
  context.counters.parity_errors += walk.parity_errors();
  return T;
}

Rgb direct_light(const LightContext& context, const Vertex& vertex, Rgb beta) {
  const Lights& lights = context.world.lights;
  if (lights.empty() || !vertex.has_smooth()) return {};
  if (context.selector.exhaustive()) {
    Rgb sum;
    for (LightId id = 0; id < lights.size(); ++id) sum += sample_light(context, vertex, beta, {id, 1.0f});
    return sum;
  }
  const auto selected = context.selector.select(vertex.light_query(), context.sampler.next_wide());
  if (!selected) return {};
  return sample_light(context, vertex, beta, *selected);
}

}  // namespace tyndall
