/// A direction and a distance on it that are drawn together for a lamp without extent [Georgiev et al. 2013, "Joint importance
/// sampling of low-order volumetric scattering", 4.2].
///
/// Seen from p, directions are uniform in the angle from the lamp, within a cone; on the ray distances are equi-angular. How few
/// rays pass the lamp at a small distance and how much light, 1/r^2, arrives there are then both in the density: of one p, what
/// is left is bounded.
#pragma once

#include <optional>

#include "tyndall/math.h"

namespace tyndall {

/// Where a ray toward a lamp scatters next.
struct LampAim {
  Vec3 w;     ///< unit, from p
  float t;    ///< > 0, length
  float pdf;  ///< of w, 1/sr; infinite toward the lamp itself
  /// 1 / (density of w and t x r^2), sr/length, where r is the distance to the lamp from there.
  float spread;
};

/// `around` in [0, 1)^2 gives the direction, `along` in [0, 1) the distance. Nothing where either rounds away, as at the lamp.
std::optional<LampAim> aim_near(Vec3 p, Vec3 lamp, Vec2 around, float along);

/// LampAim::pdf of a unit direction; 0 outside the cone.
float aim_pdf(Vec3 p, Vec3 lamp, Vec3 w);

}  // namespace tyndall
