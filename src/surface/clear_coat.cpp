#include "surface/clear_coat.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/warp.h"
#include "surface/fresnel.h"

namespace tyndall {
namespace {

/// Nodes and weights of Gauss-Legendre quadrature, on [0, 1] [Abramowitz and Stegun 1964, table 25.4].
constexpr std::array kNodes = {0.0198550717512319, 0.1016667612931866, 0.2372337950418355, 0.4082826787521751,
                               0.5917173212478248, 0.7627662049581645, 0.8983332387068134, 0.9801449282487681};
constexpr std::array kWeights = {0.0506142681451883, 0.1111905172266872, 0.1568533229389435, 0.1813418916891809,
                                 0.1813418916891809, 0.1568533229389435, 0.1111905172266872, 0.0506142681451883};

/// 2 int f(c) c dc over cosines c from `least` to `most`. c = least + (most - least) x^2 takes away the root with which
/// reflection is no longer total, and crowds where e^(-t / c) rises.
template <typename F>
double power_between(double least, double most, F f) {
  if (!(most > least)) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    const double x = kNodes[i], c = least + (most - least) * x * x;
    sum += kWeights[i] * 4 * (most - least) * x * c * f(c);
  }
  return sum;
}

/// 1 + again + again^2 + ..., `terms` of them.
double geometric_sum(double again, int terms) { return (1 - std::pow(again, terms)) / (1 - again); }

}  // namespace

CoatShares coat_shares(float eta, float thickness) {
  const double t = double{thickness}, total = std::sqrt(std::max(0.0, 1 - 1 / (double{eta} * double{eta})));
  const auto reflected = [eta](double c) { return double{fresnel_dielectric(static_cast<float>(c), 1 / eta)}; };
  const double back = power_between(0, total, [t](double c) { return std::exp(-2 * t / c); });
  return {back + power_between(total, 1, [&](double c) { return reflected(c) * std::exp(-2 * t / c); }),
          power_between(total, 1, [&](double c) { return (1 - reflected(c)) * std::exp(-t / c); })};
}

/// A walk of `max_depth` bounces is at the surface in every other one.
ClearCoatLobe::ClearCoatLobe(float eta, Rgb reflectance, const Coat& coat) : eta_(eta), thickness_(coat.thickness) {
  const CoatShares shares = coat_shares(eta, coat.thickness);
  const double eta2 = double{eta} * double{eta};
  const int visits = (coat.max_depth + 1) / 2;
  out_ = static_cast<float>(shares.out * eta2);
  for (int i = 0; i < 3; ++i) {
    const double rho = double{reflectance[i]};
    base_[i] = static_cast<float>(rho * geometric_sum(rho * shares.back, visits) / eta2);
  }
}

float ClearCoatLobe::mirrored(Vec3 w) const { return fresnel_dielectric(std::abs(w.z), eta_); }

/// Share of light along `w` that comes to the surface.
float ClearCoatLobe::enters(Vec3 w) const {
  const float inside2 = 1 - (1 - w.z * w.z) / (eta_ * eta_);
  return inside2 > 0 ? (1 - mirrored(w)) * std::exp(-thickness_ / std::sqrt(inside2)) : 0.0f;
}

/// By the power of both parts.
float ClearCoatLobe::mirror_probability(Vec3 wo) const {
  const float mirror = mirrored(wo), even = mean(base_) * enters(wo) * out_;
  return mirror > 0 ? mirror / (mirror + even) : 0.0f;
}

Rgb ClearCoatLobe::eval(Vec3 wo, Vec3 wi) const {
  return same_side(wo, wi) ? base_ * (enters(wo) * enters(wi) * std::abs(wi.z) * kInvPi) : Rgb();
}

/// By the cosine, within the cone of directions that enter.
float ClearCoatLobe::even_pdf(Vec3 wi) const {
  const float sine = std::min(eta_, 1.0f);
  return enters(wi) > 0 ? std::abs(wi.z) * kInvPi / (sine * sine) : 0.0f;
}

float ClearCoatLobe::pdf(Vec3 wo, Vec3 wi) const {
  return same_side(wo, wi) && has_smooth() ? (1 - mirror_probability(wo)) * even_pdf(wi) : 0.0f;
}

std::optional<BsdfSample> ClearCoatLobe::sample(Vec3 wo, float uc, Vec2 u) const {
  if (wo.z == 0) return std::nullopt;
  const float mirror = mirror_probability(wo);
  if (uc < mirror) {
    return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                      .weight = Rgb(mirrored(wo) / mirror),
                      .pdf = mirror,
                      .specular = true,
                      .transmission = false};
  }
  const Vec2 side = square_to_concentric_disk(u) * std::min(eta_, 1.0f);
  const Vec3 wi{side.x, side.y, std::copysign(std::sqrt(std::max(0.0f, 1 - side.x * side.x - side.y * side.y)), wo.z)};
  const float pdf = (1 - mirror) * even_pdf(wi);
  if (!(pdf > 0) || !has_smooth()) return std::nullopt;
  return BsdfSample{.wi = wi, .weight = eval(wo, wi) / pdf, .pdf = pdf, .specular = false, .transmission = false};
}

Rgb ClearCoatLobe::albedo(Vec3 wo) const { return Rgb(mirrored(wo)) + base_ * (enters(wo) * out_); }

}  // namespace tyndall
