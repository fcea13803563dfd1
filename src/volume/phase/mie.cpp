#include "volume/phase/phase.h"

namespace tyndall {
namespace {

struct Fit {
  double g_hg, g_draine, alpha, w;
};

/// Jendersie and d'Eon 2023, "An approximate Mie scattering function for fog and cloud rendering": for diameters from 5
/// micrometers equations 4 to 7, below those of its supplement, 8 to 19.
Fit fit(double d) {
  const double l = std::log(d);
  if (d >= 5)
    return {std::exp(-0.0990567 / (d - 1.67154)), std::exp(-2.20679 / (d + 3.91029) - 0.428934),
            std::exp(3.62489 - 8.29288 / (d + 5.52825)), std::exp(-0.599085 / (d - 0.641583) - 0.665888)};
  if (d >= 1.5) {
    const double ll = std::log(l);
    return {0.0604931 * ll + 0.940256, 0.500411 - 0.081287 / (-2 * l + std::tan(l) + 1.27551), 7.30354 * l + 6.31675,
            0.026914 * (l - std::cos(5.68947 * (ll - 0.0292149))) + 0.376475};
  }
  if (d > 0.1) {
    const double turn = std::cos((l - 0.238604) * (l + 1.00667) / (0.507522 - 0.15677 * l));
    return {0.862 - 0.143 * l * l, 0.379685 * std::cos(1.19692 * turn + 1.37932 * l + 0.0625835) + 0.344213, 250,
            0.146209 * std::cos(3.38707 * l + 2.11193) + 0.316072 + 0.0778917 * l};
  }
  return {13.8 * d * d, 1.1456 * d * std::sin(9.29044 * d), 250, 0.252977 - 312.983 * std::pow(d, 4.3)};
}

}  // namespace

Mie::Mie(float diameter) : diameter_(diameter) {
  const Fit f = fit(std::clamp(double{diameter}, 1e-3, double{kLargest}));
  peak_.g = static_cast<float>(f.g_hg);
  rest_ = Draine(static_cast<float>(f.g_draine), static_cast<float>(f.alpha));
  rest_share_ = static_cast<float>(f.w);
}

float Mie::pdf(Vec3 wo, Vec3 wi) const { return (1 - rest_share_) * peak_.pdf(wo, wi) + rest_share_ * rest_.pdf(wo, wi); }

PhaseSample Mie::sample(Vec3 wo, Vec2 u) const {
  const bool rest = u.x < rest_share_;
  const float x = rest ? u.x / rest_share_ : (u.x - rest_share_) / (1 - rest_share_);
  const Vec2 v{std::min(x, kOneMinusEpsilon), u.y};
  const Vec3 wi = rest ? rest_.sample(wo, v).wi : peak_.sample(wo, v).wi;
  return {wi, pdf(wo, wi)};
}

float Mie::mean_cosine() const { return (1 - rest_share_) * peak_.mean_cosine() + rest_share_ * rest_.mean_cosine(); }

}  // namespace tyndall
