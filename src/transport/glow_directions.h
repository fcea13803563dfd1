/// Directions from a surface toward media that glow.
#pragma once

#include "light/query.h"
#include "transport/media_glow.h"

namespace tyndall {

/// As seen from one point: a mixture of uniform cones, one around each cell of the glow that may be above the surface.
/// sample() and pdf() belong together; a deterministic function of the query's place, normal and sides.
class GlowDirections {
 public:
  GlowDirections(const MediaGlow& glow, const PointQuery& query);

  /// Share of directions that should be sampled here, [0, 1/2]: by what the glow is beside the light of lamps, which other
  /// surfaces have to send on.
  float share() const { return share_; }
  /// Unit; share() must not be 0.
  Vec3 sample(float u, Vec2 on_cone) const;
  float pdf(Vec3 w) const;  ///< 1/sr

 private:
  const MediaGlow* glow_;
  Vec3 p_;
  float total_ = 0, share_ = 0;
  alignas(32) MediaGlow::PerCell<float> importance_;
};

}  // namespace tyndall
