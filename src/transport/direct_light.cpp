#include "transport/direct_light.h"

#include "transport/joint_ray.h"
#include "transport/light_counts.h"
#include "transport/vertex_light.h"

namespace tyndall {
namespace {

/// Shadow rays end this fraction short of the light, so that they do not meet the emitter itself.
constexpr float kShadowEnd = 1 - 1e-4f;

}  // namespace

Rgb transmittance_along(const LightContext& context, SpanWalk& walk, const Ray& ray, Rng& rng) {
  Rgb T(1.0f);
  while (const auto i = walk.next()) {
    T *= transmittance(shadow_method(context), i->view(), ray, i->t0, i->t1, rng, context.counters.tracking);
    if (is_black(T)) break;
  }
  return T;
}

Rgb visibility(const LightContext& context, const MediaState& media, Vec3 origin, Vec3 wi, float distance, Sampler& sampler) {
  const BuiltWorld& world = context.world;
  ++context.counters.shadow_rays;
  const Ray ray{origin, wi};
  const auto crossings = world.geometry.trace_shadow(ray, 0, distance * kShadowEnd);
  if (!crossings) return {};
  if (!world.has_media()) return Rgb(1.0f);

  Rng rng = sampler.stream();
  // Through media the whole distance counts: at optical depth 4 the last 1e-4 of it is 4e-4 of the light.
  SpanWalk walk(world.media_context(), media, *crossings, distance);
  const Rgb T = transmittance_along(context, walk, ray, rng);
  context.counters.parity_errors += walk.parity_errors();
  return T;
}

LightSearch light_search(const LightContext& context, const Vertex& vertex) {
  LightSearch search;
  if (!context.world.lights.sought()) return search;
  search.query = vertex.light_query();
  if (!vertex.has_smooth() || context.selector.exhaustive()) return search;
  const auto [candidates, shadow_rays] = counts_at_vertex(context, search.query);
  search.cut = context.selector.cut(search.query, cut_settings(context, candidates));
  search.shadow_rays = shadow_rays;
  return search;
}

Rgb direct_light(const LightContext& context, const Directions& directions, const LightSearch& search, Rgb beta) {
  const Vertex& vertex = directions.vertex();
  Sampler sampler = context.sampler.fork();
  if (!context.world.lights.sought() || !vertex.has_smooth()) return {};
  // The density of the candidates stands for the technique: it is known for every direction, unlike the resampled one.
  const auto share = [&](const LightSample& light, LightId id, float density) {
    if (light.delta) return path_mis_weight(context, id);
    return mis_weight(density, directions.pdf(light.wi, beta));
  };
  return VertexLight(context, vertex, search, beta, share).estimate(sampler);
}

}  // namespace tyndall
