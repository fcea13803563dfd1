/// Settings that have been looked at, with the methods that "auto" stands for.
#pragma once

#include "session/world_parts.h"

namespace tyndall {

/// Throws Error (usage) for settings that cannot be, or that the world was not built for.
RenderSettings resolved(RenderSettings settings, const World::Parts& world);

/// Whether a render ends at an error.
bool has_error_goal(const RenderSettings& settings);
/// RenderSettings::adaptive of render(), also where it is not set.
bool is_adaptive(const RenderSettings& settings);

}  // namespace tyndall
