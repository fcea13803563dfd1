#include "transport/budget/light_counts.h"

#include <algorithm>

#include "transport/budget/faint_chance.h"

namespace tyndall {
namespace {

constexpr LightCounts kSecondVertex{2, 2}, kLater{1, 1};
/// Bounds of clusters say little of where a narrow lobe meets a light. Where most is scattered elsewhere, as under a coat, more
/// candidates are not worth their time (docs/measurements.md).
constexpr LightCounts kGlossyVertex{4, 2};
/// Where paths go on, most of the error is of later bounces, and more pairs cost more than they save, for the camera's span as
/// well (docs/measurements.md). Fewer leave fireflies among lights in smoke.
constexpr LightCounts kSecondSpan{3, 2};
/// Spans that scatter less than this share of the light take one candidate.
constexpr float kThin = 1e-3f;
constexpr LightCounts kThinSpan{1, 1};

LightCounts chosen(const RenderSettings& settings, LightCounts unless_set) {
  return {settings.candidates.value_or(unless_set.candidates), settings.shadow_rays.value_or(unless_set.shadow_rays)};
}

/// Candidates that are counted by the settings are pairs, and always sampled.
SpanCounts chosen(const RenderSettings& settings, SpanCounts unless_set) {
  const LightCounts counts = chosen(settings, static_cast<LightCounts>(unless_set));
  return settings.candidates ? SpanCounts{counts} : SpanCounts{counts, unless_set.chance};
}

/// Where paths go on not more candidates than there are lights, and a shadow ray for every other one: for one light along media
/// a single pair is the most efficient (docs/measurements.md).
LightCounts limited(const LightContext& context, LightCounts counts) {
  if (is_single_scattering(context)) return counts;
  const std::size_t lights = context.world.lights.sought(seeks_volume_lights(context));
  const int n = static_cast<int>(std::min<std::size_t>(std::max<std::size_t>(lights, 1), 1000));
  return {std::min(counts.candidates, n), std::min(counts.shadow_rays, (n + 1) / 2)};
}

/// From one point a light without extent is always the same.
LightCounts limited_at_point(const LightContext& context, LightCounts counts) {
  const Lights& lights = context.world.lights;
  if (lights.stats().points == lights.stats().lights)
    counts.candidates = std::min(counts.candidates, static_cast<int>(std::min<std::size_t>(lights.size(), 1000)));
  return limited(context, counts);
}

/// Of cuts without a limit, which have a candidate for each cluster.
constexpr float kSplitting = 0.5f;

bool mostly_glossy(const PointQuery& query) { return query.glossy() && query.diffuse < 0.5f; }

LightBudget budget_of(const LightContext& context) {
  return context.budget ? *context.budget : LightBudget::unmeasured(context.settings);
}

LightCounts counts_at_bounce(const LightContext& context, bool glossy) {
  LightCounts counts = context.smooth_bounces == 0   ? budget_of(context).vertex
                       : context.smooth_bounces == 1 ? kSecondVertex
                                                     : kLater;
  if (glossy)
    counts = {std::max(counts.candidates, kGlossyVertex.candidates), std::max(counts.shadow_rays, kGlossyVertex.shadow_rays)};
  return counts;
}

LightCounts counts_along_bounce(const LightContext& context) {
  return context.smooth_bounces == 0 ? budget_of(context).span : context.smooth_bounces == 1 ? kSecondSpan : kLater;
}

/// Where the strategy sizes its cuts itself.
constexpr LightCounts kNoLimits{0, 0};

}  // namespace

CutSettings cut_settings(const LightContext& context, int candidates) {
  if (context.settings.splitting) return {.candidates = candidates, .splitting = *context.settings.splitting};
  if (candidates == 0) return {.candidates = 0, .splitting = kSplitting};
  return {.candidates = candidates, .near_lights = true};
}

LightCounts counts_at_vertex(const LightContext& context, const LightSelector& among, const PointQuery& query) {
  if (among.sizes_cut()) return chosen(context.settings, kNoLimits);
  return chosen(context.settings, limited_at_point(context, counts_at_bounce(context, mostly_glossy(query))));
}

SpanCounts counts_along_span(const LightContext& context, const LightSelector& among, float scattered) {
  if (among.sizes_cut()) return SpanCounts{chosen(context.settings, kNoLimits)};
  SpanCounts counts{scattered < kThin ? kThinSpan : limited(context, counts_along_bounce(context))};
  if (!is_single_scattering(context)) counts.chance = faint_chance(scattered);  // around smoke many rays pass next to nothing
  return chosen(context.settings, counts);
}

}  // namespace tyndall
