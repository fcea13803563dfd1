/// Lights that a vertex has sought, and scattered rays that find them by themselves.
#pragma once

#include <optional>

#include "transport/techniques/direct_light.h"
#include "transport/techniques/span_light.h"

namespace tyndall {

/// What next-event estimation at a vertex has sampled lights by, which rays that are scattered there are weighted against.
struct SoughtLights {
  LightSearch search;
  std::optional<SpanCollision> collision;  ///< in its place when lights are chosen along the segment before the vertex

  bool volumes() const { return collision ? collision->search.volumes : search.volumes; }
  /// Density of a scattered direction in these weights, 1/sr; `drawn_with`: that of Directions.
  float pdf(const Vertex& vertex, Vec3 wi, float drawn_with) const {
    return collision ? vertex.pdf(wi, Rgb(1.0f)) : drawn_with;
  }
  /// MIS weight of a scattered ray of that density that has found light `id`, sampled with `light_pdf`, 1/sr.
  float scattering_mis_weight(const LightContext& context, float pdf, LightId id, float light_pdf) const;
};

}  // namespace tyndall
