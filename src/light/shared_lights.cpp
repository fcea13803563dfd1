#include "light/shared_lights.h"

namespace tyndall {

Bounds3 placed(const Bounds3& box, const Similarity& to_outer) {
  Bounds3 outer;
  for (int i = 0; i < 8; ++i) {
    const Vec3 rounded = to_vec3(to_outer.point(Vec3d(box.corner(i))));
    for (int k = 0; k < 3; ++k) {
      outer.min[k] = std::min(outer.min[k], std::nextafter(rounded[k], -kInfinity));
      outer.max[k] = std::max(outer.max[k], std::nextafter(rounded[k], kInfinity));
    }
  }
  return outer;
}

LightBounds placed(const LightBounds& bounds, const Similarity& to_outer, double growth) {
  LightBounds outer = bounds;
  outer.box = placed(bounds.box, to_outer);
  outer.normals.axis = to_vec3(normalize(to_outer.normal(Vec3d(bounds.normals.axis))));
  if (outer.normals.theta > 0 && !outer.normals.full()) outer.normals.theta = std::min(outer.normals.theta + 1e-6f, kPi);
  outer.intensity = static_cast<float>(std::clamp(bounds.intensity * growth, 1e-37, 1e38));
  return outer;
}

}  // namespace tyndall
