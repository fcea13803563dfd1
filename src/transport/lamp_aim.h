/// A direction and a distance on it that are drawn together for a lamp without extent [Georgiev et al. 2013, "Joint importance
/// sampling of low-order volumetric scattering", 4.2].
///
/// Seen from p, directions are uniform in the angle from the lamp, within a cone; on the ray distances go by the angle that the
/// lamp sees, as its light is scattered over it. How few rays pass the lamp at a small distance, how much light, 1/r^2, arrives
/// there and which way it is sent on are then all in the density: of one p, what is left is bounded.
#pragma once

#include <optional>

#include "tyndall/math.h"

namespace tyndall {

/// A place on an endless ray that passes a lamp.
struct PassingPlace {
  float t;       ///< distance; not finite, or not positive, where it rounds away
  float spread;  ///< 1 / (density of t x r^2), where r is the distance to the lamp from there
};
/// Drawn by the angle that the lamp sees [Kulla and Fajardo 2012], not evenly but as the phase function sends back to the ray's
/// origin what it gets at that angle. `closest`: where the ray comes closest to the lamp, of either sign; `passing` > 0: how
/// close; `g`: mean cosine; `u` in [0, 1).
PassingPlace pass_lamp(float closest, float passing, float g, float u);

/// Where a ray toward a lamp scatters next.
struct LampAim {
  Vec3 w;     ///< unit, from p
  float t;    ///< > 0, length
  float pdf;  ///< of w, 1/sr; infinite toward the lamp itself
  /// 1 / (density of w and t x r^2), sr/length, where r is the distance to the lamp from there.
  float spread;
};

/// `around` in [0, 1)^2 gives the direction, `along` in [0, 1) the distance, in a medium of mean cosine `g`. Nothing where
/// either rounds away, as at the lamp.
std::optional<LampAim> aim_near(Vec3 p, Vec3 lamp, float g, Vec2 around, float along);

/// LampAim::pdf of a unit direction; 0 outside the cone.
float aim_pdf(Vec3 p, Vec3 lamp, Vec3 w);

}  // namespace tyndall
