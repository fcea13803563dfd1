/// The importance of the wide tree's clusters in plain double precision, one at a time.
#pragma once

#include "light/wide_node.h"

namespace tyndall::test {

struct OracleImportance {
  double value = 0;   ///< in units of intensity / length^2, as child_importance() with the scale taken in
  double upper = 0;   ///< without the cosines: the unit of rounding
  double margin = 1;  ///< how far, in cosines, the tests for "none" were from deciding otherwise
};

inline OracleImportance oracle_importance(const Cluster& c, const WideQuery& q) {
  const Vec3d low(c.box.min), high(c.box.max), half = (high - low) * 0.5, d = (low + high) * 0.5 - Vec3d(q.p), n(q.n);
  const double radius = length(half), distance = length(d);
  OracleImportance result;
  if (radius == 0 && distance == 0) return result;
  const Vec3d mean = c.mean - Vec3d(q.p);
  const double reckoned = std::sqrt(dot(mean, mean) + 0.5 * c.variance);
  result.upper = c.intensity / (reckoned * reckoned);

  double factor = 1;
  if (!c.normals.full()) {
    const Vec3d axis = normalize(Vec3d(c.normals.axis));
    double bound = 1;
    if (distance > radius) {
      double theta = std::acos(std::clamp(-dot(axis, d) / distance, -1.0, 1.0));
      if (c.two_sided) theta = std::min(theta, kPi - theta);
      bound = std::cos(std::max(theta - c.normals.theta - std::asin(radius / distance), 0.0));
      result.margin = std::min(result.margin, std::abs(bound - std::cos(double(c.theta_e))));
      if (bound <= std::cos(double(c.theta_e))) return result;
      bound = std::max(bound, 1e-3);
    }
    double ahead = -dot(axis, mean) / reckoned;
    if (c.two_sided) ahead = std::abs(ahead);
    const double narrow = 0.5 * (1 + std::cos(double(c.normals.theta)));
    factor *= std::max(narrow * std::max(ahead, 0.0) + 0.5 * (1 - narrow) * bound, 0.15 * bound);
  }
  if (q.surface) {
    const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
    if (!q.transmissive) {
      result.margin = std::min(result.margin, std::abs(dot(n, d) + reach) / (distance + radius));
      if (dot(n, d) + reach <= 0) return result;
    }
    const double height = q.transmissive ? std::abs(dot(n, mean)) : dot(n, mean);
    factor *= std::clamp(std::max(height, 0.3 * (height + reach)) / reckoned, 1e-3, 1.0);
  }
  result.value = factor * result.upper;
  return result;
}

}  // namespace tyndall::test
