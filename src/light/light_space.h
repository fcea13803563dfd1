/// Light at a point, and directions in the space of a light that has an orientation.
#pragma once

#include <array>
#include <optional>

#include "light/bounds.h"
#include "tyndall/math.h"

namespace tyndall {

/// Light arriving at a point from one direction. `L` is the irradiance on a surface that faces it.
struct DeltaArrival {
  Vec3 wi;
  float distance;
  Rgb L;
};

/// I / d^2 from one point to another; nothing where that is not a finite number.
std::optional<DeltaArrival> arrival_from(Vec3 light, Vec3 p, Rgb I);

/// Of what stands at a point; without intensity.
LightBounds bounds_at(Vec3 p, DirectionCone normals, float theta_e);

/// Of a light's space; everything where the transform does not keep angles.
DirectionCone cone_in_world(const Transform& to_world, const DirectionCone& cone);

/// From directions of the world to those of a light.
class LightSpace {
 public:
  explicit LightSpace(const Transform& to_world);

  Vec3 local(Vec3 w) const { return {dot(rows_[0], w), dot(rows_[1], w), dot(rows_[2], w)}; }  ///< not normalised

 private:
  std::array<Vec3, 3> rows_;  ///< of the linear part of the inverse
};

}  // namespace tyndall
