/// What a camera's sensor and its white balance make of a picture, as one matrix.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/cie.h"

namespace tyndall {

/// pbrt-v4's names of sensors, "cie1931" first.
std::vector<std::string> sensor_names();

/// From linear Rec.709 to what a film shows with sensor `name` balanced for daylight of `kelvin`, in XYZ whose white is
/// `film_white`; null for an unknown name. "cie1931" measures XYZ and is balanced only where `kelvin` is above 0; the other
/// sensors have 6500 K where it is not.
std::optional<Matrix3> sensor_xyz_from_rec709(std::string_view name, float kelvin, Xy film_white);

}  // namespace tyndall
