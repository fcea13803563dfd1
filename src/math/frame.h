/// Orthonormal frames.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

/// Right-handed orthonormal frame; local z is the axis it was made around.
struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  /// Any frame around unit `n`, without a branch or a singularity [Duff et al. 2017].
  static Frame around(Vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  /// Frame around unit `n` with x as near `tangent` as can be; any frame when they are parallel.
  static Frame around(Vec3 n, Vec3 tangent) {
    const Vec3 t = tangent - n * dot(n, tangent);
    const float l = length(t);
    if (!(l > 1e-6f * length(tangent))) return around(n);
    // Near n little but rounding is left of the tangent, and not perpendicular: a second time makes it so.
    const Vec3 once = t / l, x = normalize(once - n * dot(n, once));
    return {x, cross(n, x), n};
  }

  Vec3 to_local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3 to_world(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace tyndall
