/// Few points, spread evenly over the unit square and along both of its sides.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/warp.h"
#include "tyndall/math.h"

namespace tyndall {

/// They are moved within one cell of their lattice, between its two shortest vectors: so the lattices of all samples together
/// are as even as the points that move them. A single point is its own lattice.
class FibonacciLattice {
 public:
  static constexpr int kFew = 5, kMany = 13;

  /// `count`: 1, kFew or kMany; `u`: in [0, 1)^2.
  FibonacciLattice(int count, Vec2 u) : count_(count), step_(count == kFew ? 3 : 8), shift_(u) {
    const float n = static_cast<float>(count);
    if (count == kFew) shift_ = {(2 * u.x + u.y) / n, (u.x - 2 * u.y) / n};
    if (count == kMany) shift_ = {(2 * u.x + 3 * u.y) / n, (3 * u.x - 2 * u.y) / n};
  }
  Vec2 operator[](int i) const {
    const float spacing = 1 / static_cast<float>(count_);
    const int row = i * step_ % count_;
    return {wrapped(shift_.x + static_cast<float>(i) * spacing), wrapped(shift_.y + static_cast<float>(row) * spacing)};
  }

 private:
  static float wrapped(float u) { return std::min(u - std::floor(u), kOneMinusEpsilon); }

  int count_, step_;
  Vec2 shift_;
};

}  // namespace tyndall
