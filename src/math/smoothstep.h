/// A step without corners.
#pragma once

#include <algorithm>

namespace tyndall {

/// 0 up to x = a, 1 from x = b on, and 3 t^2 - 2 t^3 where x is the part t of what lies between them; a != b.
inline float smoothstep(float a, float b, float x) {
  const float t = std::clamp((x - a) / (b - a), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace tyndall
