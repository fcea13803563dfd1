/// What is known of a cluster of lights: bounds of positions and directions, and how the power is distributed.
#pragma once

#include <cstdint>
#include <span>

#include "light/bounds.h"
#include "math/vec3d.h"

namespace tyndall {

struct Cluster {
  Bounds3 box;
  DirectionCone normals;
  float theta_e = 0;
  bool two_sided = false;
  std::uint32_t count = 0;      ///< lights
  double intensity = 0;         ///< sum over the lights
  double intensity_square = 0;  ///< sum of the squares
  Vec3d mean;                   ///< of position, weighted by intensity
  double variance = 0;          ///< of position about the mean, weighted likewise, the lights' own extents included

  /// (standard deviation / mean)^2 of the lights' intensities.
  double intensity_cv2() const;
};

/// Light in a uniform box has a variance of extent^2 / 12 along each axis.
Cluster cluster_of(const LightBounds& light);
/// Bounds and moments of all together [Chan et al. 1979]. Of two-sided clusters axes may be turned round.
Cluster cluster_union(std::span<const Cluster> clusters);

}  // namespace tyndall
