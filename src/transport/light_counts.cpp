#include "transport/light_counts.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr LightCounts kOnlyVertex{8, 0}, kVertex{2, 2};
/// Bounds of clusters tell little of where a narrow lobe meets a light. Where most is scattered elsewhere, as under a
/// coat, that is not worth its time: error at equal time 1.2 times that of kVertex with 10 to 1,000 lights.
constexpr LightCounts kGlossyVertex{4, 2};
/// Where paths go on, most of the error is of what comes after, and more pairs cost more than they save, for the camera's
/// span as well: 8 of them there and 4 later took 1.1 to 1.5 times the instructions for the same relMSE without the worst
/// 1 % (smoke, two fogs; 1,000 to 20,000 lights; depths of 2 to 16). Fewer than 3 later leave fireflies among lights in smoke.
constexpr LightCounts kSpan{3, 2};
constexpr SpanCounts kOnlySpan{{16, 0}};
/// Spans that scatter less than this share of the light take one candidate.
constexpr float kThin = 1e-3f;
constexpr LightCounts kThinSpan{1, 1};
/// But on the only event, spans that scatter less than this look for light the more seldom: around smoke many rays pass next to
/// nothing. Instructions in a hall around a plume 0.81, in smoke of depth 1 and 5 0.96 and 0.98, for the same error within 1 %;
/// with 0.3 the error of the first and the last grows by 1 %, that of the second by 7 %.
constexpr float kFaint = 0.1f;
/// What is scattered is known coarsely: what was not seen must be found, and weigh little more.
constexpr float kLeastChance = 1 / 16.0f;
/// In media of more than this optical depth most of the candidates are dim, and few of the distances matter. Measured in
/// smoke: at depth 10 the efficiency rises by a quarter, at 1 it would fall by a sixth.
constexpr float kDense = 3;
constexpr SpanCounts kOnlyDenseSpan{{16, 8}, 2};

LightCounts chosen(const RenderSettings& settings, LightCounts unless_set) {
  return {settings.candidates.value_or(unless_set.candidates), settings.shadow_rays.value_or(unless_set.shadow_rays)};
}

/// Candidates that are counted by the settings are pairs, and always looked at.
SpanCounts chosen(const RenderSettings& settings, SpanCounts unless_set) {
  const LightCounts counts = chosen(settings, static_cast<LightCounts>(unless_set));
  return settings.candidates ? SpanCounts{counts} : SpanCounts{counts, unless_set.distances, unless_set.chance};
}

/// Not more candidates than there are lights to seek, and a shadow ray for every other one: with one light, along media,
/// a single pair gives 1.2 to 1.7 times less error at equal time than eight of them.
LightCounts among(std::size_t lights, LightCounts counts) {
  const int n = static_cast<int>(std::clamp<std::size_t>(lights, 1, 1000));
  return {std::min(counts.candidates, n), std::min(counts.shadow_rays, (n + 1) / 2)};
}

/// Few candidates are as well drawn from the whole tree, in strata of one number: to split clusters for two or four of them
/// took 2 to 13 % more instructions for the same relMSE without the worst 1 % (metal, coats, smoke, a ceiling, a room; 4 to
/// 10,000 lights), with hardly less of it for the same samples.
constexpr int kSplitFrom = 8;
constexpr float kSplitting = 0.5f;

bool mostly_glossy(const PointQuery& query) { return query.glossy() && query.diffuse < 0.5f; }

}  // namespace

CutSettings cut_settings(const LightContext& context, int candidates) {
  const float unless_set = candidates == 0 || candidates >= kSplitFrom ? kSplitting : 0.0f;
  return {.candidates = candidates, .splitting = context.settings.splitting.value_or(unless_set)};
}

LightCounts counts_at_vertex(const LightContext& context, const PointQuery& query) {
  const Lights& lights = context.world.lights;
  if (is_only_event(context)) {
    // From one point a light without extent is always the same.
    LightCounts counts = kOnlyVertex;
    if (lights.stats().points == lights.stats().lights) counts.candidates = among(lights.sought(), counts).candidates;
    return chosen(context.settings, counts);
  }
  return chosen(context.settings, among(lights.sought(), mostly_glossy(query) ? kGlossyVertex : kVertex));
}

SpanCounts counts_along_span(const LightContext& context, float scattered, float depth) {
  const bool thin = scattered < kThin;
  if (is_only_event(context)) {
    return chosen(context.settings, thin ? SpanCounts{kThinSpan} : depth > kDense ? kOnlyDenseSpan : kOnlySpan);
  }
  SpanCounts counts{thin ? kThinSpan : among(context.world.lights.sought(), kSpan)};
  if (scattered < kFaint) counts.chance = std::max(scattered / kFaint, kLeastChance);
  return chosen(context.settings, counts);
}

}  // namespace tyndall
