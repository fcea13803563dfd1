/// Light scattered along a span: next-event estimation for a segment of a ray in place of a point of it.
#pragma once

#include <optional>

#include "transport/media/span_profile.h"
#include "transport/sample/light_context.h"
#include "transport/vertex/vertex.h"

namespace tyndall {

/// How lights are sampled along one span: span_light uses it, and MIS must know it when a ray that was scattered in the span
/// hits a light.
struct SpanSearch {
  const LightSelector* among;  ///< the lights that are sought
  bool volumes;                ///< media that emit are among them
  SegmentQuery query;
  LightCut cut;
  SpanProfile profile;
  float g = 0;           ///< mean cosine of the phase functions, roughly
  int shadow_rays = 0;   ///< to trace, 0: to all candidates
  float chance = 1;      ///< of drawing any pair; roulette decides
  bool tracked = false;  ///< a collision draws lights by this search too
};
/// Nothing when no light can be scattered, or when settings choose lights at collisions only.
std::optional<SpanSearch> span_search(const LightContext& context, const Span& span);

/// Unbiased estimate of the light that is scattered once along the span toward its origin, weighted by MIS against paths that
/// collide there and hit the light by themselves. Pairs of a light and a distance are chosen (`--media`, `--distance`),
/// evaluated without visibility, and resampled; for the survivors transmittance is estimated (light_counts.h says how many).
/// Multiply by the throughput `beta` at the origin, which is passed for weighting only.
Rgb span_light(const LightContext& context, const Span& span, const SpanSearch& search, Rgb beta);

/// Density of colliding at `t`, by the profile: 1/length. An approximation of the tracked one, used on both sides of MIS.
float collision_density(const Span& span, const SpanSearch& search, float t);

/// A collision in a span, as a technique that competes with pairs.
struct SpanCollision {
  SpanSearch search;
  float t;        ///< of the collision
  float density;  ///< collision_density there
};

/// Densities with which the techniques that choose lights sample one light from one distance: 1/length; times the light's own
/// pdf, 1/(length sr), to compare with a collision's density x phase function.
struct SpanDensities {
  float pair = 0;     ///< chosen along the span
  float tracked = 0;  ///< chosen at a collision
};
SpanDensities span_densities(const LightContext& context, const SpanCollision& collision, LightId id);

/// Next-event estimation at a collision, with the span's choice of lights, where the search is tracked.
Rgb collision_light(const LightContext& context, const Vertex& vertex, const SpanCollision& collision, Rgb beta);

/// Whether settings choose lights for segments; whether distances by the light.
bool seeks_along_spans(const LightContext& context);
bool pairs_along_spans(const RenderSettings& settings);

}  // namespace tyndall
