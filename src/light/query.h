/// The question put to light selection, and its answer.
#pragma once

#include <cstdint>

#include "tyndall/math.h"

namespace tyndall {

/// Scene::lights in order, then the primitives of every emissive shape.
using LightId = std::uint32_t;

/// Where light is gathered: what the choice of a light may depend on.
struct PointQuery {
  Vec3 p;
  Vec3 n;                     ///< unit shading normal on the side of wo; zero in a medium
  bool transmissive = false;  ///< light from below the surface counts too
  /// Scattered rays find environments too, so `sample` will be called with the same flag. Environments that are
  /// best left to them (constant ones) then have pmf 0.
  bool mis_partner = true;
};

struct SelectedLight {
  LightId light;
  float pmf;
};

}  // namespace tyndall
