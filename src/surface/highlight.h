/// Where glossy lobes peak, for those who look for light there.
#pragma once

#include <numbers>

#include "math/small_vector.h"
#include "surface/fresnel.h"
#include "surface/microfacet.h"

namespace tyndall {

struct Highlight {
  Vec3 axis;    ///< unit
  float width;  ///< radians off the axis where the lobe has fallen to about a quarter
};
using Highlights = SmallVector<Highlight, 2>;

/// Wider than this a lobe is no highlight.
inline constexpr float kBroadest = std::numbers::pi_v<float> / 4;

/// GGX falls to a quarter where tan = alpha off the normal; a reflection turns twice as far as the normal does.
inline float reflected_width(const Ggx& ggx) { return 2 * std::atan(std::max(ggx.alpha_x(), ggx.alpha_y())); }

/// In the local frame, for `wo` on either side.
inline void add_reflection(const Ggx& ggx, Vec3 wo, Highlights& highlights) {
  const float width = reflected_width(ggx);
  if (!ggx.is_mirror() && width < kBroadest) highlights.push_back({{-wo.x, -wo.y, wo.z}, width});
}

/// Into relative index `eta` (below / above). A refraction turns by about |1 - 1/eta| of what the normal does.
inline void add_transmission(const Ggx& ggx, float eta, Vec3 wo, Highlights& highlights) {
  const float relative = wo.z > 0 ? eta : 1 / eta;
  const auto wt = refract(wo, {0, 0, wo.z > 0 ? 1.0f : -1.0f}, relative);
  const float width = 0.5f * reflected_width(ggx) * std::max(std::abs(1 - 1 / relative), 0.1f);
  if (wt && !ggx.is_mirror() && width < kBroadest) highlights.push_back({*wt, width});
}

}  // namespace tyndall
