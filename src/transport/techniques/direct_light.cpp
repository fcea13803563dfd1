#include "transport/techniques/direct_light.h"

#include "transport/budget/light_counts.h"
#include "transport/techniques/mis.h"
#include "transport/techniques/next_event.h"

namespace tyndall {

LightSearch light_search(const LightContext& context, const Vertex& vertex) {
  LightSearch search;
  search.volumes = seeks_volume_lights(context);
  if (!context.world.lights.sought(search.volumes)) return search;
  search.among = &selector(context, search.volumes);
  search.query = vertex.light_query();
  if (!vertex.has_smooth() || search.among->exhaustive()) return search;
  const auto [candidates, shadow_rays] = counts_at_vertex(context, *search.among, search.query);
  search.cut = search.among->cut(search.query, cut_settings(context, candidates));
  search.shadow_rays = shadow_rays;
  return search;
}

Rgb direct_light(const LightContext& context, const Directions& directions, const LightSearch& search, Rgb beta) {
  const Vertex& vertex = directions.vertex();
  Sampler sampler = context.sampler.fork();
  if (!search.among || !vertex.has_smooth()) return {};
  // The density of the candidates stands for the technique: it is known for every direction, unlike the resampled one.
  const auto share = [&](const LightSample& light, LightId id, float density) {
    if (light.delta) return path_mis_weight(context, id);
    return mis_weight(density, directions.pdf(light.wi, beta));
  };
  return tried(context, {Spent::vertex_candidates, Spent::vertex_rays}, beta, [&](const LightContext& c, LightTrial* trial) {
    return NextEvent(c, vertex, search, beta, share).estimate(sampler, trial);
  });
}

}  // namespace tyndall
