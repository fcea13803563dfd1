/// How many lights an event looks at, and to how many of them it traces a ray.
#pragma once

#include "light/query.h"
#include "transport/light_context.h"

namespace tyndall {

struct LightCounts {
  int candidates;   ///< 0: as many as splitting makes clusters
  int shadow_rays;  ///< 0: to all candidates
};
struct SpanCounts : LightCounts {
  int distances = 1;  ///< along the span, looked at with each candidate
  float chance = 1;   ///< of looking at any
};

/// How clusters are split for that many candidates.
CutSettings cut_settings(const LightContext& context, int candidates);

/// As the settings say; unset ones by what follows the event: a path that ends there shares its cost with nothing else, so
/// it pays to look at more.
LightCounts counts_at_vertex(const LightContext& context, const PointQuery& query);
/// `scattered`: the share of light that the span scatters, roughly; `depth`: its optical depth.
SpanCounts counts_along_span(const LightContext& context, float scattered, float depth);

}  // namespace tyndall
