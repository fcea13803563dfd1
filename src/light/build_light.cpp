#include "light/build_light.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

BuildLight BuildLight::from(const TreeLight& light, double to_unit, double intensity) {
  const LightBounds& b = light.bounds;
  BuildLight l;
  for (int k = 0; k < 3; ++k) {
    l.low[k] = static_cast<float>(b.box.min[k] * to_unit);
    l.minus_high[k] = static_cast<float>(-(b.box.max[k] * to_unit));
    l.axis[k] = b.normals.axis[k];
  }
  l.theta_o = b.normals.theta;
  l.theta_e = b.theta_e;
  const double reach = std::max(double(b.normals.theta), 0.0) + 2.0 / 3 * b.theta_e;
  l.cos_reach = reach >= kPi ? -1.0f : static_cast<float>(std::cos(reach));
  l.intensity = std::max(static_cast<float>(b.intensity / intensity), 1e-37f);
  l.light = light.light & 0x7fffffff;
  l.two_sided = b.two_sided;
  return l;
}

LightBounds BuildLight::bounds() const {
  LightBounds b;
  b.box = {{low[0], low[1], low[2]}, {-minus_high[0], -minus_high[1], -minus_high[2]}};
  b.normals = DirectionCone::around({axis[0], axis[1], axis[2]}, theta_o);
  b.theta_e = theta_e;
  b.intensity = intensity;
  b.two_sided = two_sided;
  return b;
}

}  // namespace tyndall
