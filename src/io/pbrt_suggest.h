/// "Did you mean" for messages about unknown names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tyndall::pbrt {

/// Up to three of `known` that contain `name` or are spelled much like it, best first; empty when none is near.
std::vector<std::string> nearest_names(std::string_view name, const std::vector<std::string>& known);

/// "did you mean "radius" or "phimax"?"; when nothing is near, "known are "a", "b" ..." (at most twelve).
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

}  // namespace tyndall::pbrt
