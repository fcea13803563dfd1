#include "light/bounds.h"

#include "math/vec3d.h"

namespace tyndall {

void expand(LightBounds& a, const LightBounds& b) {
  if (b.box.empty()) return;
  if (a.box.empty()) {
    a = b;
    return;
  }
  a.box.expand(b.box);
  a.theta_e = std::max(a.theta_e, b.theta_e);
  a.intensity += b.intensity;
  a.two_sided = a.two_sided || b.two_sided;
  if (a.normals.full()) return;
  DirectionCone other = b.normals;
  if (a.two_sided && dot(a.normals.axis, other.axis) < 0) other.axis = -other.axis;
  a.normals = cone_union(a.normals, other);
}

LightBounds bounds_union(const LightBounds& a, const LightBounds& b) {
  LightBounds both = a;
  expand(both, b);
  return both;
}

double orientation_measure(const LightBounds& bounds) {
  constexpr double pi = 3.14159265358979323846;
  if (bounds.normals.empty()) return 0;
  if (bounds.normals.full()) return 4 * pi;
  const double o = bounds.normals.theta;
  const double w = std::min(o + bounds.theta_e, pi);
  const double sin_o = std::sin(o), cos_o = std::cos(o);
  const double skirt = 2 * w * sin_o - std::cos(o - 2 * w) - 2 * o * sin_o + cos_o;
  const double measure = 2 * pi * (1 - cos_o) + pi / 2 * skirt;
  return std::clamp(bounds.two_sided ? 2 * measure : measure, 0.0, 4 * pi);
}

double size_measure(const Bounds3& box) {
  if (box.empty()) return 0;
  const Vec3d e = Vec3d(box.max) - Vec3d(box.min);
  return 2 * (e.x * e.y + e.y * e.z + e.z * e.x) + 1e-3 * dot(e, e);
}

}  // namespace tyndall
