#include "session/render_report.h"

namespace tyndall {

RenderReport report_of(const Counters& counters, const Prices& prices) {
  RenderReport r;
  r.work = prices.parts(counters);
  const double all = prices.of(counters);
  for (const auto& [name, part] : kWorkParts) r.work.*part /= all > 0 ? all : 1;
  r.paths = counters.paths;
  r.rays = counters.rays;
  r.shadow_rays = counters.shadow_rays;
  r.density_lookups = counters.tracking.lookups;
  r.non_finite = counters.non_finite;
  r.majorant_violations = counters.tracking.majorant_violations;
  r.caps_hit = counters.tracking.caps_hit;
  r.parity_errors = counters.parity_errors;
  r.bad_samples = counters.bad_samples;
  return r;
}

void report_budget(const LightBudget& budget, RenderReport& report) {
  report.collisions_shared = budget.collisions_shared;
  if (!budget.counts_measured) return;
  report.at_vertices = {budget.vertex.candidates, budget.vertex.shadow_rays};
  report.along_segments = {budget.span.candidates, budget.span.shadow_rays};
}

void report_choices(const OpenChoices& open, const RenderSettings& decided, RenderReport& report) {
  if (open.sharing) report.sharing = decided.reuse == ReuseStrategy::pixels;
  if (open.emission) report.emission_sought = decided.emission != EmissionStrategy::paths;
  if (open.pairs) report.pairs = decided.media != MediaStrategy::vertex;
  if (open.guiding) report.guiding = decided.guiding == GuidingStrategy::media;
}

}  // namespace tyndall
