/// Directions at an angle from an axis.
#pragma once

#include <cmath>

#include "math/frame.h"

namespace tyndall {

/// Unit direction at `one_minus_cos`, in [0, 2], from the unit `axis`; `v` in [0, 1) turns it around that.
inline Vec3 direction_about(Vec3 axis, float one_minus_cos, float v) {
  const float sine = std::sqrt(one_minus_cos * (2 - one_minus_cos));
  const float phi = 2 * kPi * v;
  return normalize(Frame::around(axis).to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - one_minus_cos}));
}

}  // namespace tyndall
