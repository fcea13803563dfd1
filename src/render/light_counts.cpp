#include "render/light_counts.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr LightCounts kOnlyVertex{8, 0}, kVertex{2, 2};
/// Bounds of clusters tell little of where a narrow lobe meets a light.
constexpr LightCounts kGlossyVertex{4, 2};
/// Camera spans are looked at by every sample of a pixel, and later ones are many.
constexpr LightCounts kOnlySpan{16, 0}, kCameraSpan{8, 4}, kLaterSpan{4, 2};
/// Spans that scatter less than this share of the light take one candidate.
constexpr float kThin = 1e-3f;

LightCounts chosen(const RenderSettings& settings, LightCounts unless_set) {
  return {settings.candidates.value_or(unless_set.candidates), settings.shadow_rays.value_or(unless_set.shadow_rays)};
}

/// The event is the only one of its path.
bool only_event(const LightContext& context) { return context.event == 0 && is_last_event(context); }

}  // namespace

LightCounts counts_at_vertex(const LightContext& context, const PointQuery& query) {
  LightCounts counts = only_event(context) ? kOnlyVertex : query.glossy() ? kGlossyVertex : kVertex;
  // From one point a light without extent is always the same.
  const LightStats& lights = context.world.lights.stats();
  if (lights.points == lights.lights) counts.candidates = std::min(counts.candidates, static_cast<int>(std::max<std::size_t>(lights.lights, 1)));
  return chosen(context.settings, counts);
}

LightCounts counts_along_span(const LightContext& context, float scattered) {
  if (scattered < kThin) return chosen(context.settings, {1, 1});
  return chosen(context.settings, only_event(context) ? kOnlySpan : context.event == 0 ? kCameraSpan : kLaterSpan);
}

}  // namespace tyndall
