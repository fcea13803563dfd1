/// How a surface scatters, roughly: a cosine lobe and glossy ones. For weighting light by the direction it comes from.
#pragma once

#include <cmath>

#include "math/small_vector.h"
#include "surface/fresnel.h"
#include "surface/microfacet.h"

namespace tyndall {

/// A GGX lobe: f |cos| = share pi D(h) G |cos_o cos_t| / (l^2 cos_o) about h = wo + eta wi, with l = |h| at the peak.
struct Highlight {
  Vec3 axis;       ///< unit: toward its peak
  Vec3 tangent;    ///< unit; wo and the axis lie in the plane of it and the normal
  float slope2_t;  ///< squared width of the facets' slopes along the tangent
  float slope2_b;  ///< and across
  float eta;       ///< 1 for reflections
  float share;     ///< of the light that is scattered
};

struct Highlights {
  float diffuse = 1;  ///< share of a cosine lobe, on both sides of a surface that transmits
  SmallVector<Highlight, 2> glossy;
};

/// The lobe of `ggx` in the local frame for `wo` on either side, but for its peak.
inline Highlight highlight_of(const Ggx& ggx, Vec3 wo, float share) {
  const float side = std::hypot(wo.x, wo.y);
  const Vec3 t = side > 1e-6f ? Vec3{wo.x / side, wo.y / side, 0} : Vec3{1, 0, 0};
  const float x2 = ggx.alpha_x() * ggx.alpha_x(), y2 = ggx.alpha_y() * ggx.alpha_y();
  return {.axis = {-wo.x, -wo.y, wo.z},
          .tangent = t,
          .slope2_t = x2 * t.x * t.x + y2 * t.y * t.y,
          .slope2_b = x2 * t.y * t.y + y2 * t.x * t.x,
          .eta = 1,
          .share = share};
}

inline void add_reflection(const Ggx& ggx, Vec3 wo, float share, Highlights& highlights) {
  if (!ggx.is_mirror() && share > 0) highlights.glossy.push_back(highlight_of(ggx, wo, share));
}

/// Into relative index `eta` (below / above).
inline void add_transmission(const Ggx& ggx, float eta, Vec3 wo, float share, Highlights& highlights) {
  const float relative = wo.z > 0 ? eta : 1 / eta;
  const auto wt = refract(wo, {0, 0, wo.z > 0 ? 1.0f : -1.0f}, relative);
  if (!wt || ggx.is_mirror() || !(share > 0)) return;
  Highlight h = highlight_of(ggx, wo, share);
  h.axis = *wt;
  h.eta = relative;
  highlights.glossy.push_back(h);
}

}  // namespace tyndall
