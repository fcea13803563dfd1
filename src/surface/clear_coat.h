/// A diffuse surface under a smooth, clear coat: what the walks of LayeredLobe come to on average there, in closed form.
#pragma once

#include <optional>

#include "surface/bsdf_sample.h"
#include "surface/layered.h"

namespace tyndall {

/// Of light that a Lambertian surface sends into a smooth coat over it.
struct CoatShares {
  double back;  ///< comes back to the surface, reflected at the coat's top
  double out;   ///< leaves the coat
};

/// For a coat of index `eta` > 0 over that of the outside, and of optical `thickness` >= 0.
CoatShares coat_shares(float eta, float thickness);

/// A mirror, and an even part: f |cos| = base enters(wo) enters(wi) |cos wi| / pi. Alike from both sides, as LayeredLobe.
struct ClearCoatLobe {
  /// `reflectance` in [0, 1] of the surface; of `coat` its thickness and its bounces matter.
  ClearCoatLobe(float eta, Rgb reflectance, const Coat& coat);

  Rgb eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u) const;
  bool has_smooth() const { return !is_black(base_); }
  bool reflects() const { return true; }
  bool transmits() const { return false; }
  Rgb albedo(Vec3 wo) const;
  float mirrored(Vec3 wo) const;  ///< share of light that the coat's top mirrors

 private:
  float enters(Vec3 w) const;
  float mirror_probability(Vec3 wo) const;
  float even_pdf(Vec3 wi) const;

  float eta_, thickness_;
  float out_;  ///< share of even light from outside that comes to the surface
  Rgb base_;
};

}  // namespace tyndall
