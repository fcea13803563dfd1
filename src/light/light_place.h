/// Position and directions of a light, as much of it as choosing a distance along a ray can use.
#pragma once

#include <optional>
#include <span>

#include "light/cone.h"

namespace tyndall {

struct LightPlace {
  std::optional<Vec3> center;  ///< nothing: at infinity
  float radius = 0;            ///< of a sphere around it
  /// Unit normal of a flat light, whose plane `center` is in; zero: it is not flat. It emits to that side, or to both.
  Vec3 normal{};
  bool two_sided = false;
  /// The beam of a light without extent.
  DirectionCone beam = DirectionCone::everything();

  bool flat() const { return normal != Vec3{}; }
};

LightPlace place_of(const Bounds3& box);
/// Of a flat light, by its corners. One without a normal, as it has no area, is not taken for flat.
LightPlace flat_place(std::span<const Vec3> corners, Vec3 normal);

/// A part of a ray: empty where it does not begin before it ends.
struct RayPart {
  double begin, end;  ///< may be infinite
};

/// Where light of it may arrive on the line of a ray with unit direction: in front of a flat one, in the beam of a spot light.
/// Wider by what rounding may do to a point of the ray; all of the line for lights that emit everywhere.
RayPart lit_part(const LightPlace& light, const Ray& ray);

}  // namespace tyndall
