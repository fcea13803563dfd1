/// What a render decides by measurement.
#pragma once

#include "session/look.h"
#include "session/resolved_settings.h"

namespace tyndall {

/// Samples of each pixel that come before: the first picture is there at once, and one that shall have no more pays no pilot.
inline constexpr int kSamplesBeforePilot = 1;

/// The settings of `context`, with that of what is open which makes variance x cost least in this picture, and how many lights
/// are best asked. A function of the scene, the frame and the settings, whatever part of the picture is rendered, and by whom;
/// and of no random number that its samples use. Nothing: `watch` gave it up.
std::optional<Decision> decide(const SampleContext& context, const OpenChoices& open, ThreadPool& pool,
                               const LookWatch& watch = {});

}  // namespace tyndall
