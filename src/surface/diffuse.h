/// Lambertian reflection and transmission.
#pragma once

#include <optional>

#include "surface/bsdf_sample.h"

namespace tyndall {

/// Lobes work in the local frame, z along the shading normal. Every one has the same members; eval() is
/// f(wo, wi) |wi.z| in radiance transport, pdf() is in 1/sr.
struct DiffuseLobe {
  Rgb reflectance;  ///< [0, 1]

  Rgb eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u) const;
  bool has_smooth() const { return !is_black(reflectance); }
  bool reflects() const { return !is_black(reflectance); }
  bool transmits() const { return false; }
  Rgb albedo(Vec3) const { return reflectance; }
};

/// Lambertian on both sides; the side is sampled in proportion to the largest channels.
struct DiffuseTransmissionLobe {
  Rgb reflectance, transmittance;  ///< [0, 1] each; their sum is the scene's business, as in pbrt

  Rgb eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u) const;
  bool has_smooth() const { return reflects() || transmits(); }
  bool reflects() const { return !is_black(reflectance); }
  bool transmits() const { return !is_black(transmittance); }
  Rgb albedo(Vec3) const { return reflectance + transmittance; }
  float reflection_probability() const;
};

}  // namespace tyndall
