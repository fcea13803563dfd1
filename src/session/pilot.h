/// What a render decides by measurement.
#pragma once

#include <optional>

#include "session/look.h"
#include "session/resolved_settings.h"

namespace tyndall {

/// Samples of each pixel that come before: the first picture is soon there, and one that shall have no more pays no pilot.
inline constexpr int kSamplesBeforePilot = 1;

/// For those samples: the settings of looks.context, or these without all that is open, by a look that costs next to nothing.
/// Otherwise like decide().
std::optional<Decision> decide_first(const Looks& looks, const OpenChoices& open);

/// The settings of looks.context, with that of what is open which makes variance x cost least in this picture, and how many
/// lights are best asked. A function of the scene, the frame and the settings, whatever part of the picture is rendered, and by
/// whom; and of no random number that its samples use. Nothing: looks.watch gave it up.
std::optional<Decision> decide(const Looks& looks, const OpenChoices& open);

}  // namespace tyndall
