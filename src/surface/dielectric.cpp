#include "surface/dielectric.h"

#include "surface/albedo.h"
#include "surface/fresnel.h"

namespace tyndall {

namespace {

using Transport = LobeMode::Transport;
using Sides = LobeMode::Sides;

/// Everything seen from wo's side: wo in the upper hemisphere, `eta` = n beyond / n here.
struct View {
  View(Vec3 wo_any, float eta_below)
      : sign(wo_any.z < 0 ? -1.0f : 1.0f), wo(turn(wo_any)), eta(sign > 0 ? eta_below : 1 / eta_below) {}
  Vec3 turn(Vec3 w) const { return {w.x, w.y, sign * w.z}; }

  float sign;
  Vec3 wo;
  float eta;
};

/// The facet that takes wo to wi, by reflection or refraction.
struct Facet {
  Vec3 m;              ///< normal on wo's side
  float cos_o, cos_i;  ///< dot(wo, m) > 0, |dot(wi, m)|
  float jacobian;      ///< d m / d wi of a refraction
};

/// The half vector of a refraction is wo + eta wi; the Jacobian |i.m| / (i.m + o.m / eta)^2 [Walter et al. 2007] has
/// |half|^2 / eta^2 as its denominator.
std::optional<Facet> refracting_facet(Vec3 wo, Vec3 wi, float eta) {
  const Vec3 half = wo + wi * eta;
  const float l2 = length_squared(half);
  if (l2 == 0) return std::nullopt;
  const Vec3 m = face_forward(half / std::sqrt(l2), {0, 0, 1});
  const float cos_o = dot(wo, m), cos_i = dot(wi, m);
  if (cos_o <= 0 || cos_i >= 0) return std::nullopt;  // wo and wi on one side of the facet: no light passes
  return Facet{m, cos_o, -cos_i, -cos_i * eta * eta / l2};
}

/// Probabilities of sampling reflection and transmission, given the reflectance.
struct Split {
  Split(float reflectance, Sides sides) {
    const float r = sides == Sides::transmission ? 0 : reflectance;
    const float t = sides == Sides::reflection ? 0 : 1 - reflectance;
    if (r + t <= 0) return;
    reflection = r / (r + t);
    transmission = t / (r + t);
  }
  bool none() const { return reflection + transmission == 0; }

  float reflection = 0, transmission = 0;
};

/// Radiance is compressed on entering the denser side; importance is not.
float transport_scale(float eta, Transport transport) { return transport == Transport::radiance ? 1 / (eta * eta) : 1.0f; }

}  // namespace

Rgb DielectricLobe::eval(Vec3 wo_any, Vec3 wi_any, LobeMode mode) const {
  if (is_specular() || wo_any.z == 0 || wi_any.z == 0) return {};
  const View view(wo_any, eta);
  const Vec3 wo = view.wo, wi = view.turn(wi_any);

  if (wi.z > 0) {
    const Vec3 m = normalize(wo + wi);
    const float F = fresnel_dielectric(dot(wo, m), view.eta);
    return Rgb(0.25f * F * ggx.D(m) * ggx.G_over_cosine(wo, wi));
  }
  const auto facet = refracting_facet(wo, wi, view.eta);
  if (!facet) return {};
  const Vec3 wi_up{wi.x, wi.y, -wi.z};
  const float T = 1 - fresnel_dielectric(facet->cos_o, view.eta);
  return Rgb(T * ggx.D(facet->m) * ggx.G_over_cosine(wo, wi_up) * facet->cos_o * facet->jacobian *
             transport_scale(view.eta, mode.transport));
}

float DielectricLobe::pdf(Vec3 wo_any, Vec3 wi_any, LobeMode mode) const {
  if (is_specular() || wo_any.z == 0 || wi_any.z == 0) return 0;
  const View view(wo_any, eta);
  const Vec3 wo = view.wo, wi = view.turn(wi_any);

  if (wi.z > 0) {
    const Vec3 m = normalize(wo + wi);
    const Split split(fresnel_dielectric(dot(wo, m), view.eta), mode.sides);
    return ggx.reflected_pdf(wo, m) * split.reflection;
  }
  const auto facet = refracting_facet(wo, wi, view.eta);
  if (!facet) return 0;
  const Split split(fresnel_dielectric(facet->cos_o, view.eta), mode.sides);
  return ggx.visible_pdf(wo, facet->m) * facet->jacobian * split.transmission;
}

std::optional<BsdfSample> DielectricLobe::sample(Vec3 wo_any, float uc, Vec2 u, LobeMode mode) const {
  if (wo_any.z == 0) return std::nullopt;
  const View view(wo_any, eta);
  const Vec3 wo = view.wo;
  const bool specular = is_specular();
  const Vec3 m = specular ? Vec3{0, 0, 1} : ggx.sample_visible(wo, u);
  const float F = fresnel_dielectric(dot(wo, m), view.eta);
  const Split split(F, mode.sides);
  if (split.none()) return std::nullopt;

  // The microfacet terms cancel to the shadowing; what is left is the share the choice of a side did not take.
  if (uc < split.reflection) {
    const Vec3 wi = specular ? Vec3{-wo.x, -wo.y, wo.z} : normalize(reflect(wo, m));
    if (wi.z <= 0) return std::nullopt;
    return BsdfSample{.wi = view.turn(wi),
                      .weight = Rgb(F / split.reflection * (specular ? 1 : ggx.shadowing(wo, wi))),
                      .pdf = split.reflection * (specular ? 1 : ggx.reflected_pdf(wo, m)),
                      .specular = specular,
                      .transmission = false};
  }
  const auto wi = refract(wo, m, view.eta);
  if (!wi || wi->z >= 0) return std::nullopt;
  const float shadowing = specular ? 1 : ggx.shadowing(wo, {wi->x, wi->y, -wi->z});
  const Vec3 wi_any = view.turn(*wi);
  return BsdfSample{.wi = wi_any,
                    .weight = Rgb((1 - F) / split.transmission * shadowing * transport_scale(view.eta, mode.transport)),
                    .pdf = specular ? split.transmission : pdf(wo_any, wi_any, mode),
                    .specular = specular,
                    .transmission = true,
                    .eta = view.eta};
}

float DielectricLobe::mirrored(Vec3 wo) const { return is_specular() && wo.z > 0 ? fresnel_dielectric(wo.z, eta) : 0.0f; }

Rgb DielectricLobe::albedo(Vec3 wo) const { return is_specular() ? Rgb(1.0f) : sampled_albedo(*this, wo); }

/// R + T R T + T R^3 T + ... = R + T^2 R / (1 - R^2), with T = 1 - R.
float ThinDielectricLobe::mirrored(Vec3 wo) const {
  const float once = fresnel_dielectric(std::abs(wo.z), eta);
  return once < 1 ? once + (1 - once) * once / (1 + once) : 1.0f;
}

std::optional<BsdfSample> ThinDielectricLobe::sample(Vec3 wo, float uc, Vec2) const {
  if (wo.z == 0) return std::nullopt;
  const float R = mirrored(wo);
  if (uc < R)
    return BsdfSample{.wi = {-wo.x, -wo.y, wo.z}, .weight = Rgb(1.0f), .pdf = R, .specular = true, .transmission = false};
  return BsdfSample{.wi = -wo, .weight = Rgb(1.0f), .pdf = 1 - R, .specular = true, .transmission = true};
}

}  // namespace tyndall
