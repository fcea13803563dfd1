#include "light/light_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/vec3d.h"

namespace tyndall {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr RayPart kAll{-kEndless, kEndless}, kNone{0, 0};

/// Share of the largest coordinate that points may be off by.
constexpr double kRounding = 1e-6;
constexpr double kFlatness = 1e-4;  ///< of a flat light's radius that its points may be off its plane
/// Radians. Cosines in single precision do not tell directions apart that are within a third of it of a narrow beam's axis.
constexpr double kBeamMargin = 1e-3;
/// Wider beams light nearly all of most rays.
constexpr double kWidestBeam = 0.5 * kPi - 0.01;

RayPart in_front(Vec3d normal, Vec3d from_center, Vec3d d, double margin) {
  const double height = dot(normal, from_center) + margin, rise = dot(normal, d);
  if (rise == 0) return height >= 0 ? kAll : kNone;
  return rise > 0 ? RayPart{-height / rise, kEndless} : RayPart{-kEndless, -height / rise};
}

/// Roots of a t^2 + 2 b t + c in increasing order, without cancellation; b^2 >= a c, a != 0.
RayPart roots(double a, double b, double c) {
  const double q = -(b + std::copysign(std::sqrt(std::max(b * b - a * c, 0.0)), b));
  const double x = q / a, y = q != 0 ? c / q : x;
  return {std::min(x, y), std::max(x, y)};
}

/// The cone |v| cos(theta) <= v.axis, below a right angle. Its square, a t^2 + 2 b t + c >= 0, holds for its mirror image as
/// well.
RayPart in_cone(Vec3d axis, double theta, Vec3d from_apex, Vec3d d) {
  const double cosine = std::cos(theta), cos2 = cosine * cosine;
  const double along = dot(axis, d), height = dot(axis, from_apex);
  const double a = along * along - cos2, b = along * height - cos2 * dot(from_apex, d),
               c = height * height - cos2 * dot(from_apex, from_apex);
  if (std::abs(a) < 1e-9) return kAll;             // along the cone: one end is nearly infinite, and lost in rounding
  if (b * b < a * c) return a < 0 ? kNone : kAll;  // of lines that end in both cones, one through the apex
  const auto [first, last] = roots(a, b, c);
  if (a > 0) return along > 0 ? RayPart{last, kEndless} : RayPart{-kEndless, first};
  return height + 0.5 * (first + last) * along > 0 ? RayPart{first, last} : kNone;
}

}  // namespace

LightPlace place_of(const Bounds3& box) {
  const Vec3 half = (box.max - box.min) * 0.5f;
  return {.center = box.min + half, .radius = length(half)};
}

LightPlace flat_place(std::span<const Vec3> corners, Vec3 normal) {
  Vec3 center;
  for (const Vec3& corner : corners) center += corner * (1 / static_cast<float>(corners.size()));
  float radius2 = 0;
  for (const Vec3& corner : corners) radius2 = std::max(radius2, length_squared(corner - center));
  return {.center = center, .radius = std::sqrt(radius2), .normal = length_squared(normal) > 0 ? normal : Vec3{}};
}

RayPart lit_part(const LightPlace& light, const Ray& ray) {
  const bool faces = light.flat() && !light.two_sided;
  if (!light.center || !(faces || light.beam.theta < kWidestBeam)) return kAll;
  const Vec3d center(*light.center), o(ray.o), d(ray.d), from_center = o - center;
  const double rounding = kRounding * std::max(largest_coordinate(center), largest_coordinate(o));
  if (faces) return in_front(Vec3d(light.normal), from_center, d, kFlatness * light.radius + rounding);
  // The apex is drawn back so that its surroundings, where rounding turns directions, are inside.
  const double theta = light.beam.theta + kBeamMargin;
  const Vec3d axis(light.beam.axis);
  return in_cone(axis, theta, from_center + axis * (rounding / std::sin(theta)), d);
}

}  // namespace tyndall
