#include "volume/phase/convolved.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

/// 1 + t^2 - 2 t cosine, without what would cancel near the peak of either sign.
Float8 base(Float8 t, float below) {
  const Float8 away = 1.0f - abs(t);
  return away * away + 2.0f * abs(t) * choose(t >= 0.0f, Float8(below), Float8(2 - below));
}

Float8 henyey_greenstein(Float8 g, float below) {
  const Float8 d = base(g, below);
  return (1.0f - g) * (1.0f + g) / (4 * kPi * d * sqrt(d));
}

/// Gauss and Legendre's rule on [0, 1].
struct Rule {
  static constexpr std::size_t kHalf = 8;
  static constexpr std::array<float, kHalf> kAt{0.0950125098f, 0.2816035507f, 0.4580167776f, 0.6178762444f,
                                                0.7554044083f, 0.8656312023f, 0.9445750230f, 0.9894009349f};
  static constexpr std::array<float, kHalf> kWeight{0.1894506104f, 0.1826034150f, 0.1691565193f, 0.1495959888f,
                                                    0.1246289712f, 0.0951585116f, 0.0622535239f, 0.0271524594f};
};

/// Integral over y from 0 to 1 of y^2 / sqrt(base(t y^2)): the sum of t^l P_l / (2 l + 3).
Float8 third_sum(Float8 t, float below) {
  Float8 sum = 0.0f;
  for (std::size_t i = 0; i < Rule::kHalf; ++i) {
    for (const float side : {-1.0f, 1.0f}) {
      const float y = 0.5f + 0.5f * side * Rule::kAt[i];
      sum += 0.5f * Rule::kWeight[i] * y * y / sqrt(base(t * (y * y), below));
    }
  }
  return sum;
}

Float8 blur(const HenyeyGreenstein& phase, Float8 h, float below) {
  const float g = std::clamp(phase.g, -HenyeyGreenstein::kMaxAbsG, HenyeyGreenstein::kMaxAbsG);
  return henyey_greenstein(g * h, below);
}

/// Of 1 + cos^2 only the second Legendre polynomial is left to be blurred.
Float8 blur(const Rayleigh&, Float8 h, float below) {
  const float cosine = 1 - below, second = 0.5f * (3 * cosine * cosine - 1);
  return (1.0f + 0.5f * second * h * h) / (4 * kPi);
}

/// Draine's function for small g, whose Legendre series ends soon: moments g^l of HG, and those of cos^2 HG by the recurrence
/// of the polynomials, twice.
Float8 blur_by_series(float g, float alpha, Float8 h, float below) {
  constexpr int kTerms = 10;
  std::array<float, kTerms + 3> c{}, once{}, twice{};
  for (std::size_t l = 0; l < c.size(); ++l) c[l] = l == 0 ? 1 : c[l - 1] * g;
  const auto times_cosine = [](const auto& from, auto& to) {
    for (std::size_t l = 0; l + 1 < from.size(); ++l) {
      const auto n = static_cast<float>(l);
      to[l] = ((l > 0 ? n * from[l - 1] : 0.0f) + (n + 1) * from[l + 1]) / (2 * n + 1);
    }
  };
  times_cosine(c, once);
  times_cosine(once, twice);
  const float cosine = 1 - below;
  float p = 1, p_before = 0;  // Legendre polynomials
  Float8 sum = 0.0f, power = 1.0f;
  for (std::size_t l = 0; l < kTerms; ++l) {
    const auto n = static_cast<float>(l);
    sum += (2 * n + 1) * (c[l] + alpha * twice[l]) * p * power;
    power *= h;
    p_before = std::exchange(p, ((2 * n + 1) * cosine * p - n * p_before) / (n + 1));
  }
  return sum / (4 * kPi * (c[0] + alpha * twice[0]));
}

/// With d = 1 + g^2 - 2 g cos the function is a sum of d^(-3/2), d^(-1/2) and d^(1/2), whose Legendre series are known: the
/// first two become the same of t = g h, and the last sqrt(base(t)) + (g^2 - t^2) third_sum(t).
Float8 blur(const Draine& phase, Float8 h, float below) {
  constexpr float kSmall = 0.1f;  // below, what is divided by g^2 cancels
  const float g = phase.g(), alpha = phase.alpha();
  if (std::abs(g) < kSmall) return blur_by_series(g, alpha, h, below);
  const Float8 t = g * h, d = base(t, below), root = sqrt(d);
  const float b = 1 + g * g, k = alpha / (4 * g * g), one = (1 - g) * (1 + g);
  const Float8 sum =
      (1 + k * b * b) * (1.0f - t * t) / (d * root) + one * k * ((root + (g * g - t * t) * third_sum(t, below)) - 2 * b / root);
  return sum / (4 * kPi * (1 + alpha * (1 + 2 * g * g) / 3));
}

Float8 blur(const Mie& phase, Float8 h, float below) {
  return (1 - phase.rest_share()) * blur(phase.peak(), h, below) + phase.rest_share() * blur(phase.rest(), h, below);
}

float at(const HenyeyGreenstein& phase, float below) { return henyey_greenstein(phase.g, below)[0]; }

/// They only fall from their peak.
float most(const HenyeyGreenstein& phase, float below) { return at(phase, phase.g >= 0 ? below : 2.0f); }
float most(const Rayleigh&, float) { return 3 / (8 * kPi); }
/// In front by both factors at the edge, behind by what they are at most there.
float most(const Draine& phase, float below) {
  const float g = phase.g(), alpha = phase.alpha(), cosine = std::max(1 - below, 0.0f);
  const HenyeyGreenstein hg{g};
  const float front = most(hg, below) * (1 + alpha * cosine * cosine), back = most(hg, std::max(below, 1.0f)) * (1 + alpha);
  return std::max(front, back) / (1 + alpha * (1 + 2 * g * g) / 3);
}
float most(const Mie& phase, float below) {
  return (1 - phase.rest_share()) * most(phase.peak(), below) + phase.rest_share() * most(phase.rest(), below);
}

}  // namespace

Float8 convolved(const Phase& phase, Float8 h, float below) {
  return std::visit([&](const auto& kind) { return blur(kind, h, below); }, phase);
}

float most_beyond(const Phase& phase, float below) {
  return std::visit([&](const auto& kind) { return most(kind, below); }, phase);
}

}  // namespace tyndall
