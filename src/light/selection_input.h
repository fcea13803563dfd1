/// What the choice among lights is built from. Only src/light sees it.
#pragma once

#include "light/lights_parts.h"
#include "light/selection.h"

namespace tyndall {

/// Of all lights that are placed.
SelectionInput selection_input(const Lights::Parts& parts, const LightBuildOptions& options);

}  // namespace tyndall
