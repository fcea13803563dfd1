/// Directions from a surface toward bright media.
#pragma once

#include "light/query.h"
#include "transport/world/bright_media.h"

namespace tyndall {

/// As seen from one point: a mixture of uniform cones, one around each bright cell that may be above the surface.
/// sample() and pdf() belong together; a deterministic function of the query's place, normal and sides.
class MediaDirections {
 public:
  /// `emission_sought`: next-event estimation finds what media emit. Then it is a light among others, whose light surfaces
  /// scatter as well.
  MediaDirections(const BrightMedia& media, const PointQuery& query, bool emission_sought);

  /// Share of directions that should be sampled here, [0, 1/2]: by the radiance of the media relative to the light that other
  /// surfaces receive and scatter.
  float share() const { return share_; }
  /// Unit; share() must not be 0.
  Vec3 sample(float u, Vec2 on_cone) const;
  float pdf(Vec3 w) const;  ///< 1/sr

 private:
  using PerCell = BrightMedia::PerCell<float>;

  std::size_t size_;
  float total_ = 0, share_ = 0;
  // Of each cell, as seen from the point: the offset to its center, the square of its radius, importance over solid angle / 2
  // pi.
  alignas(32) PerCell x_, y_, z_, radius2_, density_;
  alignas(32) PerCell height_;  ///< 1 - cos of the angle of its cone; 2 is the whole sphere
};

}  // namespace tyndall
