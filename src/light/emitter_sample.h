/// What sampling an emissive surface from a point gives.
#pragma once

#include <optional>

#include "light/cone.h"
#include "math/vec3d.h"
#include "tyndall/math.h"

namespace tyndall {

/// A point that was rounded to single precision somewhere: implicitly here, or before it was mapped to where it is.
struct RoundedPoint {
  Vec3d at;
  double reach;  ///< the largest of the coordinates that were rounded, in the present unit of length

  RoundedPoint(Vec3 p) : at(p), reach(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)})) {}
  RoundedPoint(Vec3d p, double r) : at(p), reach(r) {}
};

/// A point of a surface is off it by half a last digit in each coordinate: by less than this, times RoundedPoint::reach.
inline constexpr double kRounding = 0x1p-21;

/// The observer lies in the plane through `to_plane` with normal `n` (any length > 0), as far as floats can tell: on the
/// emitter itself perhaps, which may be `off_plane` by so much. There it shows only its edge, and at heights of rounding it
/// would seem to fill half the sky of its own points.
inline bool in_plane(const RoundedPoint& p, const Vec3d& to_plane, const Vec3d& n, double off_plane = 0) {
  const double height = dot(to_plane, n), least = kRounding * p.reach + off_plane;
  return height * height <= least * least * dot(n, n);
}

struct EmitterSample {
  Vec3 wi;         ///< unit, toward the emitter
  float distance;  ///< of the point on the emitter
  Vec3 ng;         ///< unit normal there; one-sided light leaves on its side
  Vec2 uv;         ///< texture coordinates there
  float pdf;       ///< 1/sr
};

/// Bounds of an emitter's surface and of its normals.
struct EmitterExtent {
  Bounds3 box;
  DirectionCone normals;
};

/// Density per solid angle of a point at `to_point` from the observer, on a surface with normal `n` (any length),
/// sampled with density `pdf_area`; nothing where the surface is seen edge-on or the point coincides.
inline std::optional<float> solid_angle_density(double pdf_area, Vec3d to_point, Vec3d n) {
  const double d2 = dot(to_point, to_point);
  const double projected = std::abs(dot(n, to_point)) / length(n);  // d cos
  const double pdf = pdf_area * d2 * std::sqrt(d2) / projected;
  if (!(d2 > 0) || !(projected > 0) || !(pdf > 0) || !(pdf < std::numeric_limits<float>::max())) return std::nullopt;
  return static_cast<float>(pdf);
}

}  // namespace tyndall
