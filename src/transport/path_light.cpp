/// The light that a path gathers: at its bounces, and where its rays end.
#include "transport/path.h"
#include "transport/shine_light.h"
#include "transport/volume_light.h"

namespace tyndall {

/// Light from emitters that is scattered at the vertex, by a path of throughput `beta`, without what the span's pairs estimate.
Rgb Path::light_at(const Directions& directions, Rgb beta) {
  const Vertex& vertex = directions.vertex();
  span_collision_.reset();
  if (vertex.on_surface() || !span_search_) {
    search_ = light_search(context_, vertex);
    return is_black(beta) ? Rgb() : direct_light(context_, directions, search_, beta);
  }
  span_collision_ = SpanCollision{*span_search_, collision_t_, collision_density_};
  return tracks(context_.settings) ? collision_light(context_, vertex, *span_collision_, beta) : Rgb();
}

/// MIS weight of a scattered ray that found light `id`, which next-event estimation samples with `light_pdf`.
float Path::scattering_mis_weight(LightId id, float light_pdf) const {
  if (!light_sampled_ || light_pdf == 0) return 1;
  if (span_collision_) {
    const SpanDensities others = span_densities(context_, *span_collision_, id);
    return mis_weight(span_collision_->density * pdf_, others.pair * light_pdf, others.tracked * light_pdf);
  }
  return mis_weight(pdf_, context_.selector.n_pmf(search_.cut, search_.query, id) * light_pdf);
}

/// MIS weight of the volume emission along a scattered ray.
float Path::emission_mis_weight() const {
  if (!light_sampled_ || !seeks_volume_lights(context_)) return 1;
  const VolumesOnRay volumes = context_.world.volume_lights.along({from_, ray_.d});
  if (!span_collision_) return mis_weight(pdf_, volume_density(context_, search_, volumes));
  const SpanDensities others = span_volume_densities(context_, *span_collision_, volumes);
  return mis_weight(span_collision_->density * pdf_, others.pair, others.tracked);
}

void Path::add_environment() {
  const Lights& lights = context_.world.lights;
  for (const LightId id : lights.infinite()) {
    const Rgb L = lights.environment(id, ray_.d);
    if (is_black(L)) continue;
    const float pdf = light_sampled_ ? lights.environment_pdf(id, ray_.d, true) : 0.0f;
    add(seen_.value_or(beta_) * L * scattering_mis_weight(id, pdf), depth_);
  }
}

void Path::add_surface_emission(const SurfaceHit& hit) {
  const auto id = context_.world.light_of(hit);
  if (!id) return;
  const Lights& lights = context_.world.lights;
  const EmitterHit emitter{.p = hit.p, .ng = hit.ng, .uv = hit.uv, .distance = hit.t};
  const Rgb L = lights.emitted(*id, emitter, -ray_.d);
  if (is_black(L)) return;
  const float pdf = light_sampled_ ? lights.pdf(*id, from_, emitter) : 0.0f;
  const bool seen_otherwise = depth_ == 0 && context_.emitters;
  const float share =
      seen_otherwise ? context_.emitters->path_mis_weight(context_.world, *id, emitter) : scattering_mis_weight(*id, pdf);
  add(seen_.value_or(beta_) * L * share, depth_);
}

}  // namespace tyndall
