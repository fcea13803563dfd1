/// What eight clusters send toward the viewer of a glossy surface, or through the phase function of a medium.
#pragma once

#include <cmath>

#include "light/query.h"
#include "light/wide_lanes.h"

namespace tyndall {

/// Where clusters lie, as far as what is scattered goes.
struct Arrival {
  Vector8 toward;       ///< to the mean of the lights: unit, or shorter where they lie all around
  Float8 variance;      ///< of their directions
  Float8 cosine;        ///< of incidence, on the normal's side or the other, in (0, 1]
  Float8 above, below;  ///< heights over the tangent plane of the uppermost and the lowest corner
};

/// A lobe's facets as a cluster needs them: their normal, not of unit length, and the squared widths of their slopes,
/// the wider the more the cluster spreads.
struct Facets {
  Float8 t, b, n, slope2_t, slope2_b;

  [[gnu::always_inline]] Facets(const QueryLobe& lobe, const Arrival& a) {
    const auto along = [&](const Vec3& axis) {
      return lobe.eta * (axis.x * a.toward.x + axis.y * a.toward.y + axis.z * a.toward.z);
    };
    t = lobe.sin_o + along(lobe.tangent);
    b = along(lobe.bitangent);
    n = lobe.eta != 1 ? lobe.cos_o - lobe.eta * a.cosine : lobe.cos_o + a.cosine;
    slope2_t = lobe.slope2_t + lobe.spread_t * a.variance;
    slope2_b = lobe.slope2_b + lobe.spread_b * a.variance;
  }
};

/// f |cos| of a lobe, in units in which a cosine lobe has the cosine. The spread of a cluster makes the lobe wider as if
/// the facets were rougher [Tokuyoshi et al. 2024]: the lobe's mean over a Gaussian of equal moments, up to its shape.
[[gnu::always_inline]] inline Float8 glossy(const QueryLobe& lobe, const Arrival& a) {
  const auto [t, b, n, slope2_t, slope2_b] = Facets(lobe, a);
  // D(h) of slopes wide w_t, w_b is l^4 / (pi w_t w_b (t^2 / w_t^2 + b^2 / w_b^2 + n^2)^2): one division is enough.
  const Float8 product = slope2_t * slope2_b, l2 = t * t + b * b + n * n;
  const Float8 e = t * t * slope2_b + b * b * slope2_t + n * n * product;

  const float rough = 0.5f * (lobe.slope2_t + lobe.slope2_b);
  const float stretched_o = std::sqrt(rough + (1 - rough) * lobe.cos_o * lobe.cos_o);
  const Float8 stretched = sqrt(rough + (1 - rough) * a.cosine * a.cosine);
  const Float8 shadow = stretched_o * a.cosine + stretched * lobe.cos_o;  // G = 2 cos / shadow
  const Float8 value = lobe.scale * l2 * l2 * product * sqrt(product) * a.cosine / (e * e * shadow);
  return choose(lobe.eta != 1 ? a.below < 0.0f : a.above > 0.0f, value, 0.0f);
}

/// Henyey-Greenstein, in units of the isotropic phase function. Seen through it a cluster that spreads out is a light in
/// one direction seen through a broader one, since mean cosines multiply when two such functions are convolved.
[[gnu::always_inline]] inline Float8 phase(float g, Vec3 forward, const Vector8& toward, Float8 variance) {
  const Float8 cosine = forward.x * toward.x + forward.y * toward.y + forward.z * toward.z;
  const Float8 broader = g / sqrt(1 + variance), e = 1 + broader * broader - 2 * broader * cosine;
  return (1 - broader * broader) / (e * sqrt(e));
}

}  // namespace tyndall
