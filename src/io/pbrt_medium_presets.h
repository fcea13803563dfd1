/// Measured media by name, as pbrt's "preset".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tyndall/math.h"

namespace tyndall::pbrt {

/// Coefficients in 1/mm; sigma_s is the reduced one, for isotropic scattering.
struct MediumPreset {
  std::string_view name;
  Rgb sigma_s, sigma_a;
};

const MediumPreset* find_medium_preset(std::string_view name);  ///< null when unknown
std::vector<std::string> medium_preset_names();

}  // namespace tyndall::pbrt
