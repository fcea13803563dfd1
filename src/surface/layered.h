/// A surface under a clear or scattering coat: pbrt-v4's stochastic layered BSDF [Guo et al. 2018; pbrt-v4, 14.3].
#pragma once

#include <cstdint>
#include <optional>

#include "surface/conductor.h"
#include "surface/dielectric.h"
#include "surface/diffuse.h"

namespace tyndall {

/// What lies between the two interfaces, and the controls of the walk. sigma_t = 1 per unit of thickness.
struct Coat {
  float thickness = 0.01f;
  Rgb albedo = {};         ///< [0, 1]; black: absorbs only
  float g = 0;             ///< Henyey-Greenstein mean cosine
  int max_depth = 10;      ///< bounces between entering and leaving
  int samples = 1;         ///< walks per eval()
  std::uint64_t seed = 0;  ///< of this surface point; the walks hash it with their directions
};

/// A dielectric interface over an opaque lobe, alike from both sides (pbrt's twoSided).
///
/// eval() is the mean of `samples` unbiased random walks, the same for the same arguments. sample() walks until the
/// path leaves, so its weight is unbiased though no density is known; pdf() is a deterministic stand-in for MIS.
template <typename Bottom>
struct LayeredLobe {
  DielectricLobe top;
  Bottom bottom;
  Coat coat;

  Rgb eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u) const;
  bool has_smooth() const { return top.has_smooth() || bottom.has_smooth() || !is_black(coat.albedo); }
  bool reflects() const { return true; }
  bool transmits() const { return false; }
  Rgb albedo(Vec3 wo) const;
  /// Share of light that the coat's top mirrors; 0 where that is not all that specular samples bring.
  float mirrored(Vec3 wo) const;
};

using CoatedDiffuseLobe = LayeredLobe<DiffuseLobe>;
using CoatedConductorLobe = LayeredLobe<ConductorLobe>;

extern template struct LayeredLobe<DiffuseLobe>;
extern template struct LayeredLobe<ConductorLobe>;

}  // namespace tyndall
