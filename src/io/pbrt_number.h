/// Numbers of scene and mesh texts, independent of the locale.
#pragma once

#include <cstdint>
#include <string_view>

namespace tyndall::pbrt {

enum class NumberFault { none, not_a_number, out_of_range };

/// Decimal or exponent notation with an optional sign; never inf or nan. Too small becomes 0, too large is a fault.
NumberFault parse_number(std::string_view text, double& out);
NumberFault parse_number(std::string_view text, float& out);
/// A 32-bit integer in decimal.
NumberFault parse_number(std::string_view text, std::int32_t& out);

}  // namespace tyndall::pbrt
