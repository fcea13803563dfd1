/// What the light tree knows of a light, or of a cluster of them: position, directions, power.
#pragma once

#include "light/cone.h"
#include "tyndall/math.h"

namespace tyndall {

/// Light leaves points of `box` within `theta_e` of a normal in `normals`, with at most about `intensity` W/sr
/// straight along the normal. Two-sided light leaves along the opposite directions as well.
struct LightBounds {
  Bounds3 box;
  DirectionCone normals;
  float theta_e = 0;
  float intensity = 0;
  bool two_sided = false;
};

/// The scalar that selection uses for a colour: the mean magnitude of its channels, 0 for black alone.
inline double strength(Rgb c) { return (std::abs(double(c.r)) + std::abs(double(c.g)) + std::abs(double(c.b))) / 3; }

/// Bounds of both clusters together. Of a two-sided pair an axis may be turned round if that narrows the cone.
LightBounds bounds_union(const LightBounds& a, const LightBounds& b);
void expand(LightBounds& a, const LightBounds& b);  ///< a = bounds_union(a, b)

/// Solid angle of the normals plus the cosine-weighted falloff of their emission, in [0, 4 pi]:
/// the orientation measure of the surface area orientation heuristic [Conty Estevez and Kulla 2018, eq. 1].
double orientation_measure(const LightBounds& bounds);

/// Size measure of the heuristic: the surface area of the box, with a small share of its squared diagonal so that
/// flat and thin clusters are still told apart by size, at any scale.
double size_measure(const Bounds3& box);

}  // namespace tyndall
