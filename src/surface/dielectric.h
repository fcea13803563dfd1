/// Glass: a smooth or rough interface, a thin pane, and no interface at all.
#pragma once

#include <optional>

#include "surface/bsdf_sample.h"
#include "surface/microfacet.h"

namespace tyndall {

/// Reflection and transmission at the boundary of a dielectric whose inside is below the surface, z < 0.
struct DielectricLobe {
  float eta = 1.5f;  ///< n below / n above
  Ggx ggx;

  /// Microfacet reflection and transmission [Walter et al. 2007].
  Rgb eval(Vec3 wo, Vec3 wi, LobeMode mode = {}) const;
  float pdf(Vec3 wo, Vec3 wi, LobeMode mode = {}) const;
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u, LobeMode mode = {}) const;
  /// A mirror, or an index so near 1 that the refracted lobe is narrower than a float direction resolves.
  bool is_specular() const { return ggx.is_mirror() || std::abs(eta - 1) < 1e-4f; }
  bool has_smooth() const { return !is_specular(); }
  bool reflects() const { return eta != 1; }
  bool transmits() const { return true; }
  Rgb albedo(Vec3 wo) const;
  /// Share of light from outside that a smooth interface mirrors; 0 from within, where what is mirrored is within as well.
  float mirrored(Vec3 wo) const;
};

/// A flat pane without thickness, all orders of reflection inside it summed; never bends a ray.
struct ThinDielectricLobe {
  float eta = 1.5f;

  Rgb eval(Vec3, Vec3) const { return {}; }
  float pdf(Vec3, Vec3) const { return 0; }
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u) const;
  bool has_smooth() const { return false; }
  bool reflects() const { return eta != 1; }
  bool transmits() const { return true; }
  Rgb albedo(Vec3) const { return Rgb(1.0f); }
  float mirrored(Vec3 wo) const;
};

/// Lets everything through: an interface material that a mix has chosen.
struct PassThroughLobe {
  Rgb eval(Vec3, Vec3) const { return {}; }
  float pdf(Vec3, Vec3) const { return 0; }
  std::optional<BsdfSample> sample(Vec3 wo, float, Vec2) const {
    return BsdfSample{.wi = -wo, .weight = Rgb(1.0f), .pdf = 1, .specular = true, .transmission = true};
  }
  bool has_smooth() const { return false; }
  bool reflects() const { return false; }
  bool transmits() const { return true; }
  Rgb albedo(Vec3) const { return Rgb(1.0f); }
};

}  // namespace tyndall
