/// The methods that `compare` is asked to set side by side.
#pragma once

#include <string>
#include <vector>

#include "report/compare.h"

namespace tyndall::cli {

/// "lights, media, distance, emission, guiding, joint, reuse, budget, transmittance, all, adaptive": one preset for each axis
/// of strategies, all of them, and samples where the error is beside as many everywhere.
std::string preset_names();

/// `specs`: presets and "name:--lights power --media vertex --adaptive", also several in one, separated by commas or
/// semicolons. What a variant does not set is as in `base`. Equal methods under the name of several presets appear once. Throws
/// Error (usage) that lists what is known.
std::vector<CompareVariant> parse_variants(const std::vector<std::string>& specs, const RenderSettings& base);

/// Throws Error (usage) when the pictures of variants with these names would be one file.
void require_own_files(const std::string& a, const std::string& b);

}  // namespace tyndall::cli
