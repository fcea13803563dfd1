/// Metals: a mirror, or GGX microfacets.
#pragma once

#include <optional>

#include "surface/bsdf_sample.h"
#include "surface/microfacet.h"

namespace tyndall {

struct ConductorLobe {
  Ggx ggx;
  Rgb eta, k;  ///< complex index relative to the outside

  /// Torrance-Sparrow: f = D F G / (4 cos_o cos_i) [pbrt-v4, 9.6].
  Rgb eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u) const;
  bool has_smooth() const { return !ggx.is_mirror(); }
  bool reflects() const { return true; }
  bool transmits() const { return false; }
  Rgb albedo(Vec3 wo) const;
};

/// Index with the given reflectance at normal incidence: eta = 1, k = 2 sqrt(r / (1 - r)), as pbrt-v4.
Rgb conductor_k(Rgb reflectance);

}  // namespace tyndall
