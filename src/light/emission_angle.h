/// Angles as pairs of cosine and sine: adding and subtracting them takes no inverse function and loses no bits.
#pragma once

#include <algorithm>
#include <cmath>

#include "light/importance.h"

namespace tyndall {

/// Margin, in cosines, for the rounding of float axes and normals here and in the lights' own evaluation.
inline constexpr double kCosineSlack = 1e-6;
/// Factors never fall below this unless the test says "none": at the rim a cosine may round to 0 or below.
inline constexpr double kLeastFactor = 1e-3;

struct Angle {
  double cos, sin;
  static Angle from_cosine(double c) {
    c = std::clamp(c, -1.0, 1.0);
    return {c, std::sqrt((1 - c) * (1 + c))};
  }
  static Angle from_sine(double s) { return {std::sqrt((1 - s) * (1 + s)), s}; }  ///< s in [0, 1]
};

/// max(a - b, 0) by the subtraction identities.
inline Angle reduced(Angle a, Angle b) {
  if (a.cos >= b.cos) return {1, 0};
  return {a.cos * b.cos + a.sin * b.sin, a.sin * b.cos - a.cos * b.sin};
}

/// min(a + b, pi).
inline Angle increased(Angle a, Angle b) {
  if (a.cos <= -b.cos) return {-1, 0};
  return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
}

/// The largest cosine at which light leaves a cluster for a receiver in a direction that makes an angle of at least
/// `theta` with the axis, the cluster being seen under `theta_u`. 0: none does.
inline double emission_factor(const ClusterBounds& cluster, Angle theta, Angle theta_u) {
  const Angle beyond = reduced(reduced(theta, Angle::from_cosine(cluster.cos_o)), theta_u);
  if (beyond.cos <= cluster.cos_e - kCosineSlack) return 0;
  return std::max(beyond.cos, kLeastFactor);
}

}  // namespace tyndall
