/// What a job tells of itself, from what it has counted and decided.
#pragma once

#include "session/resolved_settings.h"
#include "transport/budget/light_budget.h"
#include "transport/sample/prices.h"

namespace tyndall {

/// Of what is counted; all else as it is without samples.
RenderReport report_of(const Counters& counters, const Prices& prices);
/// Adds what was measured of lights asked and collisions shared.
void report_budget(const LightBudget& budget, RenderReport& report);
/// Adds what was decided of what the settings had left open.
void report_choices(const OpenChoices& open, const RenderSettings& decided, RenderReport& report);

}  // namespace tyndall
