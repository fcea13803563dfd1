/// A direction and a distance on it that are drawn together for a light without extent [Georgiev et al. 2013, "Joint importance
/// sampling of low-order volumetric scattering", 4.2].
///
/// From p, directions are uniform in the angle from the light, within a cone; distances on the ray are distributed by the angle
/// at the light, times the phase function at the collision. That few rays pass the light closely, the 1/r^2 that arrives there
/// and the phase function are then all in the density: for one p the weight is bounded.
#pragma once

#include <optional>

#include "tyndall/math.h"

namespace tyndall {

/// A place on an endless ray that passes a light.
struct PassingPlace {
  float t;       ///< distance; not finite, or not positive, where it rounds away
  float spread;  ///< 1 / (density of t x r^2), where r is the distance to the light from there
};
/// Drawn by the angle at the light [Kulla and Fajardo 2012], not evenly but by the phase function for that angle, toward the
/// ray's origin. `closest`: where the ray comes closest to the light, of either sign; `passing` > 0: how close; `g`: mean
/// cosine; `u` in [0, 1).
PassingPlace pass_point(float closest, float passing, float g, float u);

/// Where a ray toward a light scatters next.
struct PointAim {
  Vec3 w;     ///< unit, from p
  float t;    ///< > 0, length
  float pdf;  ///< of w, 1/sr; infinite toward the light itself
  /// 1 / (density of w and t x r^2), sr/length, where r is the distance to the light from there.
  float spread;
};

/// `around` in [0, 1)^2 gives the direction, `along` in [0, 1) the distance, in a medium of mean cosine `g`. Nothing where
/// either rounds away, as at the light.
std::optional<PointAim> aim_near(Vec3 p, Vec3 point, float g, Vec2 around, float along);

/// PointAim::pdf of a unit direction; 0 outside the cone.
float aim_pdf(Vec3 p, Vec3 point, Vec3 w);

}  // namespace tyndall
