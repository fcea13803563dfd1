/// How a picture is rendered.
#pragma once

#include <optional>

#include "transport/budget/light_budget.h"
#include "tyndall/settings.h"

namespace tyndall {

/// What the options leave open is closed in the settings.
struct Decision {
  RenderSettings settings;
  std::optional<LightBudget> budget;  ///< nothing: no number was measured
};

}  // namespace tyndall
