/// The light that a path gathers: at its events, and where its rays end.
#include "transport/fire_light.h"
#include "transport/path.h"
#include "transport/shine_light.h"

namespace tyndall {

/// Light from emitters that is scattered at the vertex, by a path of throughput `beta`. What the span's pairs stand for is
/// not in it.
Rgb Path::light_at(const Directions& directions, Rgb beta) {
  const Vertex& vertex = directions.vertex();
  span_event_.reset();
  if (vertex.on_surface() || !span_search_) {
    search_ = light_search(context_, vertex);
    return is_black(beta) ? Rgb() : direct_light(context_, directions, search_, beta);
  }
  span_event_ = SpanEvent{*span_search_, collision_t_, collision_density_};
  return tracks(context_.settings) ? collision_light(context_, vertex, *span_event_, beta) : Rgb();
}

/// MIS weight of a scattered ray that found light `id`, which next-event estimation samples with `light_pdf`.
float Path::scattering_share(LightId id, float light_pdf) const {
  if (!light_sampled_ || light_pdf == 0) return 1;
  if (span_event_) {
    const SpanDensities others = span_densities(context_, *span_event_, id);
    return mis_weight(span_event_->density * pdf_, others.pair * light_pdf, others.tracked * light_pdf);
  }
  return mis_weight(pdf_, context_.selector.expected(search_.cut, search_.query, id) * light_pdf);
}

/// MIS weight of what a scattered ray gathers from glowing media.
float Path::emission_share() const {
  if (!light_sampled_ || !seeks_fire(context_)) return 1;
  const FiresOnRay fires = context_.world.fire.along({from_, ray_.d});
  if (!span_event_) return mis_weight(pdf_, fire_density(context_, search_, fires));
  const SpanDensities others = span_fire_densities(context_, *span_event_, fires);
  return mis_weight(span_event_->density * pdf_, others.pair, others.tracked);
}

void Path::add_environment() {
  const Lights& lights = context_.world.lights;
  for (const LightId id : lights.infinite()) {
    const Rgb L = lights.environment(id, ray_.d);
    if (is_black(L)) continue;
    const float pdf = light_sampled_ ? lights.environment_pdf(id, ray_.d, true) : 0.0f;
    add(seen_.value_or(beta_) * L * scattering_share(id, pdf), depth_);
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
  const bool seen_otherwise = depth_ == 0 && context_.shine;
  const float share = seen_otherwise ? context_.shine->own_share(context_.world, *id, emitter) : scattering_share(*id, pdf);
  add(seen_.value_or(beta_) * L * share, depth_);
}

}  // namespace tyndall
