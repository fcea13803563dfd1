/// How many candidates a vertex or span draws, and to how many of them it traces a shadow ray.
#pragma once

#include "light/query.h"
#include "transport/budget/light_budget.h"
#include "transport/sample/light_context.h"

namespace tyndall {

struct SpanCounts : LightCounts {
  float chance = 1;  ///< probability of drawing any
};

/// How clusters are split for that many candidates.
CutSettings cut_settings(const LightContext& context, int candidates);

/// Among the lights that `among` chooses from. As the settings say; unset ones by the budget. Where `among` sizes its cuts
/// itself (LightSelector::sizes_cut) the settings are limits, and unset ones none.
LightCounts counts_at_vertex(const LightContext& context, const LightSelector& among, const PointQuery& query);
/// `scattered`: the fraction of light that the span scatters, roughly.
SpanCounts counts_along_span(const LightContext& context, const LightSelector& among, float scattered);

}  // namespace tyndall
