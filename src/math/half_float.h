/// The upper 16 bits of a float: its whole range with 8 bits of mantissa ("bfloat16"). For stored bounds and weights.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace tyndall {

inline float from_upper_half(std::uint16_t bits) { return std::bit_cast<float>(std::uint32_t(bits) << 16); }

/// The least that is >= x, for x >= 0 and finite; what would overflow becomes infinity.
inline std::uint16_t upper_half_above(double x) {
  float f = static_cast<float>(x);
  if (static_cast<double>(f) < x) f = std::nextafter(f, INFINITY);
  return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(f) + 0xffff) >> 16);
}

/// The nearest, for x >= 0 and finite.
inline std::uint16_t upper_half_near(double x) {
  return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(static_cast<float>(x)) + 0x8000) >> 16);
}

}  // namespace tyndall
