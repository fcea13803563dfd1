/// What a render decides by measurement before it begins.
#pragma once

#include "session/look.h"
#include "session/resolved_settings.h"

namespace tyndall {

/// The settings of `context`, with that of what is open which makes variance x cost least in this picture, and how many lights
/// are best asked. A function of the scene, the frame and the settings, whatever part of the picture is rendered, and by whom;
/// and of no random number that its samples use.
Decision decide(const SampleContext& context, const OpenChoices& open, ThreadPool& pool);

}  // namespace tyndall
