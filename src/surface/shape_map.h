/// Affine maps that stay in double precision, for the intersection tests that must be exact or nearly so.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vec3d.h"

namespace tyndall {

inline Vec3d abs(Vec3d a) { return {std::abs(a.x), std::abs(a.y), std::abs(a.z)}; }
inline double max_component(Vec3d a) { return std::max({a.x, a.y, a.z}); }

/// Both directions of a Transform, applied without leaving double precision.
struct AffineMap {
  AffineMap() = default;
  explicit AffineMap(const Transform& t) : forward_(t.matrix()), backward_(t.inverse().matrix()) {}

  Vec3d point(Vec3d p) const { return apply(forward_, p, 1); }
  Vec3d vector(Vec3d v) const { return apply(forward_, v, 0); }
  Vec3d normal(Vec3d n) const {  ///< by the inverse transpose; not normalised
    const auto& m = backward_;
    return {m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z, m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
            m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z};
  }
  Vec3d inverse_point(Vec3d p) const { return apply(backward_, p, 1); }
  Vec3d inverse_vector(Vec3d v) const { return apply(backward_, v, 0); }

 private:
  static Vec3d apply(const Transform::Matrix& m, Vec3d v, double w) {
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z + m[0][3] * w,
            m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z + m[1][3] * w,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z + m[2][3] * w};
  }

  Transform::Matrix forward_ = Transform().matrix(), backward_ = Transform().matrix();
};

}  // namespace tyndall
