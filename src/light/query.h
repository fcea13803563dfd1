/// The question put to light selection, and its answer.
#pragma once

#include <array>
#include <cstdint>

#include "tyndall/math.h"

namespace tyndall {

/// Scene::lights in order, then the primitives of every emissive shape.
using LightId = std::uint32_t;

/// Directions that a glossy surface favours, or a phase function with a forward peak.
struct QueryLobe {
  Vec3 axis;        ///< unit, toward the light that it favours
  float width = 0;  ///< radians off the axis where it has fallen considerably; 0: no lobe
};

/// Where light is gathered: what the choice of a light may depend on.
struct PointQuery {
  Vec3 p;
  Vec3 n;                     ///< unit shading normal on the side of wo; zero in a medium
  bool transmissive = false;  ///< light from below the surface counts too
  /// Scattered rays find environments too, so `sample` will be called with the same flag. Environments that are
  /// best left to them (constant ones) then have pmf 0.
  bool mis_partner = true;
  std::array<QueryLobe, 2> lobes{};  ///< clusters inside them are split sooner
};

struct SelectedLight {
  LightId light;
  float pmf;
};

}  // namespace tyndall
