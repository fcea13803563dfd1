/// The Trowbridge-Reitz (GGX) microfacet distribution, in the local frame of the surface.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

/// Heights with elliptical slopes of widths alpha_x, alpha_y [Trowbridge and Reitz 1975; Walter et al. 2007].
///
/// All directions are in the upper hemisphere, z > 0. With s(w) = |(alpha_x w.x, alpha_y w.y, w.z)| the Smith terms
/// are 1 + Lambda(w) = (s + z) / (2 z); the methods below cancel the 1/z by hand, so that grazing directions are safe.
class Ggx {
 public:
  Ggx() = default;
  Ggx(float alpha_x, float alpha_y);

  /// Both widths below 1e-3: treated as a perfect mirror, as in pbrt-v4.
  bool is_mirror() const { return mirror_; }
  float alpha_x() const { return ax_; }
  float alpha_y() const { return ay_; }

  float D(Vec3 m) const;
  /// G(wo, wi) / wo.z, height-correlated masking and shadowing in a form without poles.
  float G_over_cosine(Vec3 wo, Vec3 wi) const;
  /// G(wo, wi) / G1(wo): the weight of a direction made from a visible normal.
  float shadowing(Vec3 wo, Vec3 wi) const;

  /// A normal as seen from `w`: density D(m) G1(w) dot(w, m) / w.z [Heitz 2018].
  Vec3 sample_visible(Vec3 w, Vec2 u) const;
  float visible_pdf(Vec3 w, Vec3 m) const;  ///< 1/sr of m
  /// Density of `wo` mirrored at a visible normal `m`, 1/sr of the mirrored direction: visible_pdf / (4 dot(wo, m)).
  float reflected_pdf(Vec3 wo, Vec3 m) const;

 private:
  float stretched(Vec3 w) const { return length(Vec3{ax_ * w.x, ay_ * w.y, w.z}); }

  float ax_ = 0, ay_ = 0;
  bool mirror_ = true;
};

/// alpha of a user's roughness in [0, 1], pbrt-v4's remaproughness.
inline float roughness_to_alpha(float roughness) { return std::sqrt(std::max(0.0f, roughness)); }

}  // namespace tyndall
