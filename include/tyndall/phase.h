/// Phase functions: how a medium turns light that it scatters.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "tyndall/math.h"

namespace tyndall {

/// A direction drawn from a phase function.
struct PhaseSample {
  Vec3 wi;    ///< unit, leaves the vertex
  float pdf;  ///< 1/sr; equals the value of the phase function
};

// Each kind has
//   pdf(wo, wi)     value and density, 1/sr; wo and wi, unit, both leave the vertex, so that forward is wi = -wo
//   sample(wo, u)   exactly of that density; u in [0, 1)^2
//   mean_cosine()   of the angle between -wo and wi: what choices of light go by
//   parameters()    what tells two of the kind apart
// and stands in the list Phase, below.

/// (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)) [Henyey and Greenstein 1941].
/// Any g in [-1, 1] is safe: |g| is held at kMaxAbsG, where the lobe is 1e-5 rad wide.
struct HenyeyGreenstein {
  static constexpr float kMaxAbsG = 0.99999f;
  float g = 0;  ///< mean cosine

  /// The base is taken as (1 - |g|)^2 + 2 |g| (1 - cos), and 1 - cos from the difference of the vectors: as it stands it would
  /// cancel to noise for |g| near 1.
  float pdf(Vec3 wo, Vec3 wi) const {
    const float h = std::min(std::abs(g), kMaxAbsG);
    const float one_minus_cos = 0.5f * length_squared(g >= 0 ? wi + wo : wi - wo);
    const float base = (1 - h) * (1 - h) + 2 * h * one_minus_cos;
    return (1 - h) * (1 + h) / (4 * kPi * base * std::sqrt(base));
  }
  PhaseSample sample(Vec3 wo, Vec2 u) const;
  float mean_cosine() const { return g; }
  std::array<float, 1> parameters() const { return {g}; }
};

/// 3 / (16 pi) (1 + cos^2): molecules, and what is small beside the wavelength.
struct Rayleigh {
  float pdf(Vec3 wo, Vec3 wi) const;
  PhaseSample sample(Vec3 wo, Vec2 u) const;
  float mean_cosine() const { return 0; }
  std::array<float, 0> parameters() const { return {}; }
};

/// HG times (1 + alpha cos^2), normalised [Draine 2003]: HG for alpha = 0, Cornette and Shanks' for 1, Rayleigh's for g = 0,
/// alpha = 1.
class Draine {
 public:
  /// `g` in (-1, 1), taken as 0 below 1e-4; `alpha` >= 0.
  explicit Draine(float g = 0, float alpha = 1);
  float pdf(Vec3 wo, Vec3 wi) const;
  PhaseSample sample(Vec3 wo, Vec2 u) const;
  float mean_cosine() const;
  std::array<float, 2> parameters() const { return {hg_.g, alpha_}; }
  float g() const { return hg_.g; }
  float alpha() const { return alpha_; }

 private:
  HenyeyGreenstein hg_;
  float alpha_;
};

/// Droplets of water in air: (1 - w) HG + w Draine, fitted to Mie's solution by their diameter [Jendersie and d'Eon 2023].
class Mie {
 public:
  static constexpr float kLargest = 50;
  /// Micrometers, in (0, kLargest]; fog has 5 to 30, haze below 2.
  explicit Mie(float diameter = 10);
  float pdf(Vec3 wo, Vec3 wi) const;
  PhaseSample sample(Vec3 wo, Vec2 u) const;
  float mean_cosine() const;
  std::array<float, 1> parameters() const { return {diameter_}; }
  // (1 - rest_share()) peak() + rest_share() rest()
  const HenyeyGreenstein& peak() const { return peak_; }
  const Draine& rest() const { return rest_; }
  float rest_share() const { return rest_share_; }

 private:
  float diameter_;
  HenyeyGreenstein peak_;
  Draine rest_;
  float rest_share_;
};

/// One of them.
using Phase = std::variant<HenyeyGreenstein, Rayleigh, Draine, Mie>;

inline bool operator==(const Phase& a, const Phase& b) {
  if (a.index() != b.index()) return false;
  return std::visit(
      [&](const auto& kind) { return kind.parameters() == std::get<std::decay_t<decltype(kind)>>(b).parameters(); }, a);
}

}  // namespace tyndall
