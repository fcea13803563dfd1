/// Where a path goes from a vertex: as it scatters there, and from the surface met first also toward media that glow.
#pragma once

#include <optional>

#include "transport/glow_directions.h"
#include "transport/light_context.h"
#include "transport/vertex.h"

namespace tyndall {

/// Path guiding by a mixture of densities [Vorba et al. 2014], by what is known of the scene instead of what was learned.
class Directions {
 public:
  /// Of the event that context.event counts.
  Directions(const LightContext& context, const Vertex& vertex);

  const Vertex& vertex() const { return vertex_; }
  /// 1/sr, of sample(); `beta` as for a Vertex.
  float pdf(Vec3 wi, Rgb beta) const;
  std::optional<ScatterSample> sample(Rgb beta, float uc, Vec2 u) const;

 private:
  float mixed(float guided, float scattered) const { return (1 - glow_->share()) * scattered + glow_->share() * guided; }
  std::optional<ScatterSample> toward_glow(Rgb beta, float u, Vec2 on_cone) const;

  const Vertex& vertex_;
  std::optional<GlowDirections> glow_;
};

}  // namespace tyndall
