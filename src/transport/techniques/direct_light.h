/// Next-event estimation at a vertex.
#pragma once

#include <cmath>
#include <optional>

#include "transport/media/span_walk.h"
#include "transport/vertex/directions.h"

namespace tyndall {

/// MIS weight of the technique with density `a` against a competing one with density `b`: the power heuristic with exponent 2
/// [Veach 1997], safe for zero, huge and infinite densities.
inline float mis_weight(float a, float b) {
  if (!(b > 0)) return 1;
  if (!(a > 0)) return 0;
  if (a == b) return 0.5f;    // infinite both, perhaps
  const float ratio = b / a;  // may round to 0 or infinity; both give the right limit
  return 1 / (1 + ratio * ratio);
}
/// The same for three techniques.
inline float mis_weight(float a, float b, float c) {
  if (!(a > 0)) return b > 0 || c > 0 ? 0.0f : 1.0f;
  const float first = b / a, second = c / a;
  return std::isnan(first) || std::isnan(second) ? 0.0f : 1 / (1 + first * first + second * second);
}

/// Of a shadow ray's media, by `walk`, which is left where nothing more gets through.
Rgb transmittance_along(const LightContext& context, SpanWalk& walk, const Ray& ray, Rng& rng);

/// As Lights::sample, for all kinds of light.
std::optional<LightSample> sample_light(const LightContext& context, LightId light, Vec3 p, Vec2 u);

/// Transmittance and visibility from `origin` to `light`.
Rgb arriving(const LightContext& context, const MediaState& media, Vec3 origin, const LightSample& light, Sampler& sampler);

/// How lights are sampled at one vertex: direct_light uses it, and MIS must know it when a scattered ray hits one.
struct LightSearch {
  const LightSelector* among = nullptr;  ///< the lights that are sought; null: there are none
  bool volumes = false;                  ///< media that emit are among them
  PointQuery query;
  LightCut cut;
  int shadow_rays = 0;  ///< to trace, 0: to all candidates
};
LightSearch light_search(const LightContext& context, const Vertex& vertex);

/// Unbiased estimate of the light scattered at `vertex` toward the path, weighted by MIS against scattered rays that hit
/// emitters. Candidates are chosen and evaluated without visibility; some are traced, resampled by their contribution
/// (resampling.h); light_counts.h says how many.
/// Multiply by the throughput `beta`, which is passed for the densities only.
Rgb direct_light(const LightContext& context, const Directions& directions, const LightSearch& search, Rgb beta);

}  // namespace tyndall
