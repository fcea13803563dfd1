/// Light from what is not at infinity, roughly: for choices, never for estimates.
#pragma once

#include <algorithm>

#include "tyndall/math.h"

namespace tyndall {

class NearFluence {
 public:
  NearFluence() = default;
  /// Of lights in `box` of that power together, W.
  NearFluence(const Bounds3& box, float power) : box_(box), power_(power) {}

  /// At `p`, were all in the middle of their box, but half its diagonal away at least; without visibility.
  float at(Vec3 p) const {
    if (power_ == 0) return 0;
    const float half = 0.5f * length(box_.extent());
    return power_ / (4 * kPi * std::max(length_squared(p - box_.center()), half * half));
  }

 private:
  Bounds3 box_;
  float power_ = 0;
};

}  // namespace tyndall
