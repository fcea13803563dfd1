#include "volume/phase/direction.h"
#include "volume/phase/phase.h"

namespace tyndall {
namespace {

/// The cosine whose distribution function is `u` for g = 0: c + alpha c^3 / 3 = (2 u - 1) (1 + alpha / 3), by the one real root
/// of a cubic that only rises.
double symmetric_cosine(double alpha, double u) {
  const double right = (2 * u - 1) * (1 + alpha / 3);
  if (alpha < 1e-6) return right;
  const double root = std::sqrt(alpha);
  return 2 / root * std::sinh(std::asinh(1.5 * root * right) / 3);
}

/// The same for g in [1e-4, 1), by s = (1 + g^2 - 2 g cos)^(1/2) from 1 - g to 1 + g, over which the density goes as
/// (1 + alpha cos^2) / s^2 with the integral -(1 + alpha b^2 / 4 g^2) / s + alpha / (4 g^2) (s^3 / 3 - 2 b s), b = 1 + g^2. In
/// double precision what cancels leaves seven digits at least.
class Inversion {
 public:
  Inversion(double g, double alpha) : g_(g), alpha_(alpha), b_(1 + g * g), k_(alpha / (4 * g * g)) {}

  double cosine(double u) const {
    double low = 1 - g_, high = 1 + g_;
    const double begin = integral(low), all = integral(high) - begin, wanted = begin + (1 - u) * all;
    double s = (1 - g_ * g_) / (1 - g_ + 2 * g_ * u);  // as HG has it
    // Newton's steps where they stay within what is known, halves elsewhere: 53 of those would do.
    for (int i = 0; i < 60; ++i) {
      const double error = integral(s) - wanted;
      (error > 0 ? high : low) = s;
      if (std::abs(error) <= 1e-12 * all) break;
      const double c = cosine_of(s), step = error * s * s / (1 + alpha_ * c * c);
      const double next = s - step;
      s = next > low && next < high ? next : 0.5 * (low + high);
    }
    return cosine_of(s);
  }

 private:
  double cosine_of(double s) const { return (b_ - s * s) / (2 * g_); }
  double integral(double s) const { return -(1 + k_ * b_ * b_) / s + k_ * (s * s * s / 3 - 2 * b_ * s); }

  double g_, alpha_, b_, k_;
};

/// Mean of 1 + alpha cos^2 over HG.
float mean_factor(float g, float alpha) { return 1 + alpha * (1 + 2 * g * g) / 3; }

}  // namespace

Draine::Draine(float g, float alpha) : hg_{std::abs(g) < 1e-4f ? 0.0f : g}, alpha_(alpha) {}

float Draine::pdf(Vec3 wo, Vec3 wi) const {
  const float cosine = dot(wo, wi);
  return hg_.pdf(wo, wi) * (1 + alpha_ * cosine * cosine) / mean_factor(hg_.g, alpha_);
}

PhaseSample Draine::sample(Vec3 wo, Vec2 u) const {
  if (alpha_ == 0) return hg_.sample(wo, u);
  const double g = std::min(std::abs(hg_.g), HenyeyGreenstein::kMaxAbsG);
  const double cosine = g == 0 ? symmetric_cosine(alpha_, u.x) : Inversion(g, alpha_).cosine(u.x);
  const auto one_minus_cos = static_cast<float>(std::clamp(1 - cosine, 0.0, 2.0));
  const Vec3 wi = direction_about(hg_.g >= 0 ? -wo : wo, one_minus_cos, u.y);
  return {wi, pdf(wo, wi)};
}

float Draine::mean_cosine() const {
  const float g = hg_.g;
  return g * (1 + alpha_ * (3 + 2 * g * g) / 5) / mean_factor(g, alpha_);
}

}  // namespace tyndall
