#include "light/cone.h"

#include "math/frame.h"
#include "math/vec3d.h"

namespace tyndall {
namespace {

constexpr double kPi64 = 3.14159265358979323846;

/// What rounding the new axis to float and adding up angles can cost.
constexpr double kWidening = 5e-7;

}  // namespace

double angle_between(Vec3 a, Vec3 b) {
  const Vec3d x = normalize(Vec3d(a)), y = normalize(Vec3d(b));
  return 2 * std::atan2(length(x - y), length(x + y));
}

DirectionCone cone_union(const DirectionCone& a, const DirectionCone& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const DirectionCone& wide = a.theta >= b.theta ? a : b;
  const DirectionCone& narrow = a.theta >= b.theta ? b : a;
  if (wide.full() || wide.axis == narrow.axis) return wide;

  // The common case cheaply: cos(k) is at most its series cut after a positive term.
  const float k2 = (wide.theta - narrow.theta) * (wide.theta - narrow.theta);
  const float cos_bound = 1 - k2 / 2 * (1 - k2 / 12 * (1 - k2 / 30 * (1 - k2 / 56)));
  if (dot(wide.axis, narrow.axis) >= cos_bound + 2e-6f) return wide;

  const double d = angle_between(wide.axis, narrow.axis);
  if (std::min(d + narrow.theta, kPi64) <= wide.theta) return wide;
  const double theta = 0.5 * (wide.theta + d + narrow.theta);
  if (theta + kWidening >= kPi64) return DirectionCone::everything();

  // Turn the axis of the wider cone toward the other, in the plane of both. Opposite axes have no such plane of their
  // own: any will do.
  const Vec3d from = normalize(Vec3d(wide.axis)), to = normalize(Vec3d(narrow.axis));
  Vec3d side = to - from * dot(to, from);
  if (length(side) < 1e-9) side = Vec3d(Frame::around(wide.axis).x);
  side = side - from * dot(side, from);
  const double turn = theta - wide.theta;
  const Vec3d axis = normalize(from * std::cos(turn) + normalize(side) * std::sin(turn));
  return {to_vec3(axis), static_cast<float>(theta + kWidening)};
}

}  // namespace tyndall
