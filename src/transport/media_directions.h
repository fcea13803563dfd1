/// Directions from a surface toward bright media.
#pragma once

#include "light/query.h"
#include "transport/bright_media.h"

namespace tyndall {

/// As seen from one point: a mixture of uniform cones, one around each bright cell that may be above the surface.
/// sample() and pdf() belong together; a deterministic function of the query's place, normal and sides.
class MediaDirections {
 public:
  MediaDirections(const BrightMedia& media, const PointQuery& query);

  /// Share of directions that should be sampled here, [0, 1/2]: by the radiance of the media relative to the light that other
  /// surfaces receive and scatter.
  float share() const { return share_; }
  /// Unit; share() must not be 0.
  Vec3 sample(float u, Vec2 on_cone) const;
  float pdf(Vec3 w) const;  ///< 1/sr

 private:
  const BrightMedia* media_;
  Vec3 p_;
  float total_ = 0, share_ = 0;
  alignas(32) BrightMedia::PerCell<float> importance_;
};

}  // namespace tyndall
