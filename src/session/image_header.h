/// What a rendered image says about itself.
#pragma once

#include "session/world_parts.h"

namespace tyndall {

/// Attribute: names of light groups, "key,sky,default", in the order of their sums in slices.
inline constexpr const char* kLightGroups = "tyndall/lightGroups";

/// Attribute: what else than samples may have ended the render, as options: "--time 60 --error 0.01"; only where there is any.
inline constexpr const char* kEnd = "tyndall/end";

/// Attribute: with mattes, hash_names of the scene.
inline constexpr const char* kMatteNames = "tyndall/matteNames";

/// Attribute: bins of the deep image that was rendered along.
inline constexpr const char* kDeepBins = "tyndall/deepBins";

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
