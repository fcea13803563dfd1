#include "surface/conductor.h"

#include "surface/albedo.h"
#include "surface/fresnel.h"

namespace tyndall {

namespace {

Vec3 mirrored(Vec3 w) { return {w.x, w.y, std::abs(w.z)}; }  ///< into the upper hemisphere

}  // namespace

Rgb ConductorLobe::eval(Vec3 wo_any, Vec3 wi_any) const {
  if (ggx.is_mirror() || !same_side(wo_any, wi_any)) return {};
  const Vec3 wo = mirrored(wo_any), wi = mirrored(wi_any);
  const Vec3 m = normalize(wo + wi);
  const float cos_m = dot(wo, m);
  return fresnel_conductor(cos_m, eta, k) * (0.25f * ggx.D(m) * ggx.G_over_cosine(wo, wi));
}

float ConductorLobe::pdf(Vec3 wo_any, Vec3 wi_any) const {
  if (ggx.is_mirror() || !same_side(wo_any, wi_any)) return 0;
  const Vec3 wo = mirrored(wo_any);
  const Vec3 m = normalize(wo + mirrored(wi_any));
  return ggx.reflected_pdf(wo, m);
}

std::optional<BsdfSample> ConductorLobe::sample(Vec3 wo_any, float, Vec2 u) const {
  if (wo_any.z == 0) return std::nullopt;
  const Vec3 wo = mirrored(wo_any);
  const float sign = wo_any.z < 0 ? -1.0f : 1.0f;
  if (ggx.is_mirror())
    return BsdfSample{.wi = {-wo.x, -wo.y, wo_any.z},
                      .weight = fresnel_conductor(wo.z, eta, k),
                      .pdf = 1,
                      .specular = true,
                      .transmission = false};

  const Vec3 m = ggx.sample_visible(wo, u);
  const Vec3 wi = normalize(reflect(wo, m));
  if (wi.z <= 0) return std::nullopt;
  return BsdfSample{.wi = {wi.x, wi.y, sign * wi.z},
                    .weight = fresnel_conductor(dot(wo, m), eta, k) * ggx.shadowing(wo, wi),
                    .pdf = ggx.reflected_pdf(wo, m),
                    .specular = false,
                    .transmission = false};
}

Rgb ConductorLobe::albedo(Vec3 wo) const {
  return ggx.is_mirror() ? fresnel_conductor(std::abs(wo.z), eta, k) : sampled_albedo(*this, wo);
}

Rgb conductor_k(Rgb reflectance) {
  const auto k = [](float r) {
    const float bounded = std::clamp(r, 0.0f, 0.9999f);  // k is infinite at 1
    return 2 * std::sqrt(bounded / (1 - bounded));
  };
  return {k(reflectance.r), k(reflectance.g), k(reflectance.b)};
}

}  // namespace tyndall
