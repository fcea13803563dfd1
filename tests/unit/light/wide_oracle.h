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
  const double nearest = std::max(distance, 0.5 * radius);
  result.upper = c.intensity / (nearest * nearest);

  double factor = 1;
  const bool outside = distance > radius;
  const double theta_u = outside ? std::asin(radius / distance) : kPi;
  const auto angle = [&](Vec3d v, double sign) {
    return std::acos(std::clamp(sign * dot(v, d) / (length(v) * distance), -1.0, 1.0));
  };
  if (outside && !c.normals.full()) {
    const Vec3d axis(c.normals.axis);
    double theta = angle(axis, -1);
    if (c.two_sided) theta = std::min(theta, kPi - theta);
    const double cosine = std::cos(std::max(theta - c.normals.theta - theta_u, 0.0));
    result.margin = std::min(result.margin, std::abs(cosine - std::cos(double(c.theta_e))));
    if (cosine <= std::cos(double(c.theta_e))) return result;
    factor *= std::max(cosine, 1e-3);
  }
  if (q.surface) {
    const double top = dot(n, d) + std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
    if (!q.transmissive) {
      result.margin = std::min(result.margin, std::abs(top) / (distance + radius));
      if (top <= 0) return result;
    }
    if (outside) {
      double theta = angle(n, 1);
      if (q.transmissive) theta = std::min(theta, kPi - theta);
      factor *= std::max(std::cos(std::max(theta - theta_u, 0.0)), 1e-3);
    }
  }
  result.value = factor * result.upper;
  return result;
}

}  // namespace tyndall::test
