#include "surface/clear_coat.h"

#include <algorithm>
#include <cmath>

#include "math/warp.h"
#include "surface/albedo.h"
#include "surface/fresnel.h"

namespace tyndall {
namespace {

/// 1 + again + again^2 + ..., `terms` of them.
double geometric_sum(double again, int terms) { return (1 - std::pow(again, terms)) / (1 - again); }

/// Of directions from which light enters.
float largest_sine(const DielectricLobe& top) { return top.is_specular() ? std::min(top.eta, 1.0f) : 1.0f; }

}  // namespace

/// A walk of `max_depth` bounces is at the surface in every other one.
ClearCoatLobe::ClearCoatLobe(const DielectricLobe& top, Rgb reflectance, const Coat& coat, const CoatShares& shares)
    : top_(top), thickness_(coat.thickness), out_(static_cast<float>(shares.out)), entering_(shares.entering) {
  const double eta2 = double{top.eta} * double{top.eta};
  const int visits = (coat.max_depth + 1) / 2;
  for (int i = 0; i < 3; ++i) {
    const double rho = double{reflectance[i]};
    base_[i] = static_cast<float>(rho * geometric_sum(rho * shares.back, visits) / eta2);
  }
}

float ClearCoatLobe::reflected(Vec3 wo) const { return fresnel_dielectric(std::abs(wo.z), top_.eta); }

/// Share of light along `w` that comes to the surface.
float ClearCoatLobe::enters(Vec3 w) const {
  if (entering_.empty()) return enters_smooth(top_.eta, thickness_, std::abs(w.z));
  const float x = std::sqrt(std::min(std::abs(w.z), 1.0f)) * static_cast<float>(entering_.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), entering_.size() - 2);
  return std::lerp(entering_[i], entering_[i + 1], x - static_cast<float>(i));
}

/// By the power of both parts.
float ClearCoatLobe::top_probability(Vec3 wo) const {
  const float top = reflected(wo), even = mean(even_albedo(wo));
  return top > 0 ? top / (top + even) : 0.0f;
}

SeparablePart ClearCoatLobe::separable_part(Vec3 wo) const { return {enters(wo), 1 - top_probability(wo)}; }

Rgb ClearCoatLobe::eval(Vec3 wo, Vec3 wi) const {
  if (!same_side(wo, wi)) return {};
  if (wo.z < 0) return eval(-wo, -wi);
  return top_.eval(wo, wi) + base_ * (enters(wo) * enters(wi) * wi.z * kInvPi);
}

/// By the cosine, within the cone of directions that enter.
float ClearCoatLobe::even_pdf(Vec3 wi) const {
  const float sine = largest_sine(top_);
  return enters(wi) > 0 ? wi.z * kInvPi / (sine * sine) : 0.0f;
}

Vec3 ClearCoatLobe::sample_even(Vec2 u) const {
  const Vec2 side = square_to_concentric_disk(u) * largest_sine(top_);
  return {side.x, side.y, std::sqrt(std::max(0.0f, 1 - side.x * side.x - side.y * side.y))};
}

float ClearCoatLobe::pdf(Vec3 wo, Vec3 wi) const {
  if (!same_side(wo, wi) || !has_smooth()) return 0;
  if (wo.z < 0) return pdf(-wo, -wi);
  const float top = top_probability(wo), by_top = top_.has_smooth() ? top_.pdf(wo, wi, kReflected) : 0.0f;
  return top * by_top + (1 - top) * even_pdf(wi);
}

std::optional<BsdfSample> ClearCoatLobe::sample(Vec3 wo, float uc, Vec2 u) const {
  if (wo.z == 0) return std::nullopt;
  if (wo.z < 0) {
    auto s = sample(-wo, uc, u);
    if (s) s->wi = -s->wi;
    return s;
  }
  const float top = top_probability(wo);
  auto s =
      uc < top
          ? top_.sample(wo, 0, u, kReflected)
          : std::optional(BsdfSample{.wi = sample_even(u), .weight = {}, .pdf = 0, .specular = false, .transmission = false});
  if (!s) return std::nullopt;
  if (s->specular) {
    s->weight *= 1 / top;
    s->pdf = top;
    return s;
  }
  s->pdf = pdf(wo, s->wi);
  if (!(s->pdf > 0)) return std::nullopt;
  s->weight = eval(wo, s->wi) / s->pdf;
  return s;
}

Rgb ClearCoatLobe::albedo(Vec3 wo) const {
  return top_.is_specular() ? Rgb(reflected(wo)) + even_albedo(wo) : sampled_albedo(*this, wo);
}

}  // namespace tyndall
