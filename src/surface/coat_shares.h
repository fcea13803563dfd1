/// How a clear coat over a Lambertian surface divides light between outside and inside.
#pragma once

#include <vector>

#include "surface/dielectric.h"

namespace tyndall {

/// Depends on the coat's top and thickness alone.
struct CoatShares {
  double back;  ///< of light that leaves the surface: what comes back to it, reflected at the coat's top
  double out;   ///< of even light from outside: what comes to the surface
  /// What comes to it from a direction of cosine x^2, for x from 0 to 1 in equal steps. Empty under smooth tops, where it is
  /// cheaper to work out.
  std::vector<float> entering;
};

/// `top`: smooth, or rough alike in all directions and of an index >= 1: below, facets reflect light totally here and there,
/// which what is kept is too coarse for. `thickness`: optical, >= 0.
CoatShares coat_shares(const DielectricLobe& top, float thickness);

/// Share of light from a direction of `cosine` that comes to the surface under a smooth top of index `eta`.
float enters_smooth(float eta, float thickness, float cosine);

}  // namespace tyndall
