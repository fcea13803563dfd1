/// Settings that have been looked at, with the methods that "auto" stands for.
#pragma once

#include "session/world_parts.h"

namespace tyndall {

/// Throws Error (usage) for settings that cannot be, or that the world was not built for.
RenderSettings resolved(RenderSettings settings, const World::Parts& world);

/// What `given` leaves open that resolved() has found a method for, and that can make a difference in this world.
struct OpenChoices {
  bool sharing = false;   ///< RenderSettings::reuse
  bool emission = false;  ///< RenderSettings::emission: media that emit are lights, or found by rays alone
  bool pairs = false;     ///< along segments, instead of RenderSettings::media as vertex
  bool guiding = false;
  bool any() const { return sharing || emission || pairs || guiding; }
};
OpenChoices open_choices(const RenderSettings& given, const RenderSettings& resolved, const World::Parts& world);

/// Whether a render ends at an error.
bool has_error_goal(const RenderSettings& settings);
/// RenderSettings::adaptive of render(), also where it is not set.
bool is_adaptive(const RenderSettings& settings);

}  // namespace tyndall
