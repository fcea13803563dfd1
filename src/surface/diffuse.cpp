#include "surface/diffuse.h"

#include "math/warp.h"

namespace tyndall {

namespace {

float cosine_pdf(Vec3 w) { return std::abs(w.z) * kInvPi; }

/// Cosine-distributed on the side of `wo`, or on the other one.
Vec3 cosine_direction(Vec3 wo, Vec2 u, bool other_side) {
  Vec3 w = square_to_cosine_hemisphere(u);
  if ((wo.z < 0) != other_side) w.z = -w.z;
  return w;
}

}  // namespace

Rgb DiffuseLobe::eval(Vec3 wo, Vec3 wi) const { return same_side(wo, wi) ? reflectance * cosine_pdf(wi) : Rgb{}; }

float DiffuseLobe::pdf(Vec3 wo, Vec3 wi) const { return same_side(wo, wi) ? cosine_pdf(wi) : 0.0f; }

std::optional<BsdfSample> DiffuseLobe::sample(Vec3 wo, float, Vec2 u) const {
  if (wo.z == 0 || is_black(reflectance)) return std::nullopt;
  const Vec3 wi = cosine_direction(wo, u, false);
  if (wi.z == 0) return std::nullopt;
  return BsdfSample{.wi = wi, .weight = reflectance, .pdf = cosine_pdf(wi), .specular = false, .transmission = false};
}

float DiffuseTransmissionLobe::reflection_probability() const {
  const float r = max_component(reflectance), t = max_component(transmittance);
  return r + t > 0 ? r / (r + t) : 0.0f;
}

Rgb DiffuseTransmissionLobe::eval(Vec3 wo, Vec3 wi) const {
  if (same_side(wo, wi)) return reflectance * cosine_pdf(wi);
  return opposite_sides(wo, wi) ? transmittance * cosine_pdf(wi) : Rgb{};
}

float DiffuseTransmissionLobe::pdf(Vec3 wo, Vec3 wi) const {
  if (!has_smooth()) return 0;
  const float reflection = reflection_probability();
  if (same_side(wo, wi)) return reflection * cosine_pdf(wi);
  return opposite_sides(wo, wi) ? (1 - reflection) * cosine_pdf(wi) : 0.0f;
}

std::optional<BsdfSample> DiffuseTransmissionLobe::sample(Vec3 wo, float uc, Vec2 u) const {
  if (wo.z == 0 || !has_smooth()) return std::nullopt;
  const float reflection = reflection_probability();
  const bool transmission = uc >= reflection;
  const Vec3 wi = cosine_direction(wo, u, transmission);
  if (wi.z == 0) return std::nullopt;
  const float probability = transmission ? 1 - reflection : reflection;
  return BsdfSample{.wi = wi,
                    .weight = (transmission ? transmittance : reflectance) / probability,
                    .pdf = probability * cosine_pdf(wi),
                    .specular = false,
                    .transmission = transmission};
}

}  // namespace tyndall
