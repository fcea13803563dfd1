/// What a rendered image says about itself.
#pragma once

#include "session/world_parts.h"

namespace tyndall {

/// Every option of the command line that chooses a method, with its value: "--max-depth 5 --lights tree ...". Settings that
/// differ give texts that differ.
std::string options_text(const RenderSettings& settings);
/// What decides besides these how many samples each pixel of an adaptive render gets; the mean's goal does only beside that of
/// the worst error.
std::string plan_text(const RenderSettings& settings);

/// Whether the image of a file was to end where these settings say.
bool says_end(const Image& image, const RenderSettings& settings);

/// Add camera matrices, the scene's hash, samples, seed, options, version and (unless reproducible) date and time taken.
void write_header(Image& image, const World::Parts& world, const RenderSettings& settings, const RenderReport& report);

}  // namespace tyndall
