/// The Henyey-Greenstein phase function.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/frame.h"
#include "tyndall/math.h"

namespace tyndall {

struct PhaseSample {
  Vec3 wi;    ///< unit, leaves the vertex
  float pdf;  ///< 1/sr; equals the value of the phase function
};

/// Henyey-Greenstein with mean cosine `g`; wo and wi both leave the vertex, so that g > 0 favours wi near -wo.
/// Any g in [-1, 1] is safe: |g| is held at kMaxAbsG, where the lobe is 1e-5 rad wide.
struct HenyeyGreenstein {
  static constexpr float kMaxAbsG = 0.99999f;
  float g = 0;

  /// Value and density in 1/sr: (1 - g^2) / (4 pi (1 + g^2 + 2 g wo.wi)^(3/2)).
  /// The base is taken as (1 - |g|)^2 + 2 |g| (1 - cos), and 1 - cos from the difference of the vectors:
  /// as it stands it would cancel to noise for |g| near 1.
  float pdf(Vec3 wo, Vec3 wi) const {
    const float h = std::min(std::abs(g), kMaxAbsG);
    const float one_minus_cos = 0.5f * length_squared(g >= 0 ? wi + wo : wi - wo);
    const float base = (1 - h) * (1 - h) + 2 * h * one_minus_cos;
    return (1 - h) * (1 + h) / (4 * kPi * base * std::sqrt(base));
  }

  /// Exact inversion. With a = 1 - |g| and q = (1 - g^2) / (a + 2 |g| u):
  /// cos = (1 + g^2 - q^2) / (2 |g|), rewritten as 1 - cos = a (1 - u) (q + a) / (a + 2 |g| u), good down to g = 0.
  PhaseSample sample(Vec3 wo, Vec2 u) const {
    const float h = std::min(std::abs(g), kMaxAbsG);
    const float a = 1 - h;
    const float d = a + 2 * h * u.x;
    const float q = a * (1 + h) / d;
    const float one_minus_cos = std::clamp(a * (1 - u.x) * (q + a) / d, 0.0f, 2.0f);
    const float sine = std::sqrt(one_minus_cos * (2 - one_minus_cos));
    const float phi = 2 * kPi * u.y;
    const Frame frame = Frame::around(g >= 0 ? -wo : wo);
    const Vec3 wi = normalize(frame.to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - one_minus_cos}));
    return {wi, pdf(wo, wi)};
  }
};

}  // namespace tyndall
