/// Affine maps in double precision: from the world to the index space of a grid.
#pragma once

#include <algorithm>
#include <array>

#include "tyndall/math.h"

namespace tyndall {

/// A point or direction in the index space of a grid.
struct GridVec {
  std::array<double, 3> v{};
  constexpr double operator[](int i) const { return v[static_cast<std::size_t>(i)]; }
  constexpr double& operator[](int i) { return v[static_cast<std::size_t>(i)]; }
};

/// An axis-aligned box in double precision; may be empty (lo > hi).
struct Box3d {
  GridVec lo, hi;
  bool contains(const GridVec& p) const {
    return p[0] >= lo[0] && p[0] <= hi[0] && p[1] >= lo[1] && p[1] <= hi[1] && p[2] >= lo[2] && p[2] <= hi[2];
  }
  bool empty() const { return !(lo[0] <= hi[0] && lo[1] <= hi[1] && lo[2] <= hi[2]); }
};

/// What both hold.
inline Box3d overlap(const Box3d& a, const Box3d& b) {
  Box3d both;
  for (int i = 0; i < 3; ++i) {
    both.lo[i] = std::max(a.lo[i], b.lo[i]);
    both.hi[i] = std::min(a.hi[i], b.hi[i]);
  }
  return both;
}

/// Three rows of a 4x4 matrix whose last row is 0 0 0 1.
struct Affine {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  static Affine of(const Transform& transform) {
    Affine a;
    for (std::size_t i = 0; i < 3; ++i) a.rows[i] = transform.matrix()[i];
    return a;
  }
  GridVec point(Vec3 p) const { return apply(p, 1); }
  GridVec vector(Vec3 p) const { return apply(p, 0); }
  /// This map, then minus `offset`.
  Affine minus(const GridVec& offset) const {
    Affine a = *this;
    for (int i = 0; i < 3; ++i) a.rows[static_cast<std::size_t>(i)][3] -= offset[i];
    return a;
  }

 private:
  GridVec apply(Vec3 p, double w) const {
    GridVec r;
    for (std::size_t i = 0; i < 3; ++i) r.v[i] = rows[i][0] * p.x + rows[i][1] * p.y + rows[i][2] * p.z + rows[i][3] * w;
    return r;
  }
};

}  // namespace tyndall
