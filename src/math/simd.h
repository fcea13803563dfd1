/// Eight numbers at once. The only interface to the compiler's SIMD types.
///
/// Arithmetic, comparisons, sqrt, min, max, abs and clamp work on each of the eight; choose(m, a, b) is m ? a : b.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>

namespace tyndall {

using Float8 = std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, 8>>;
using Mask8 = Float8::mask_type;

inline Float8 load8(const float* values) { return Float8(values, std::experimental::element_aligned); }

/// The bits of eight numbers as eight of another kind. Without registers of 256 bits the library's type is made of several
/// and no longer trivial, as std::bit_cast wants it.
template <typename To, typename From>
To bits8(const From& from) {
  if constexpr (std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>) {
    return std::bit_cast<To>(from);
  } else {
    std::array<typename From::value_type, 8> values;
    from.copy_to(values.data(), std::experimental::element_aligned);
    return To(std::bit_cast<std::array<typename To::value_type, 8>>(values).data(), std::experimental::element_aligned);
  }
}

/// Integers as floats.
template <typename Integer>
Float8 load8(const Integer* values) {
  using Narrow = std::experimental::rebind_simd_t<Integer, Float8>;
  return std::experimental::static_simd_cast<Float8>(Narrow(values, std::experimental::element_aligned));
}

/// The upper halves of floats (math/half_float.h).
inline Float8 load8_upper(const std::uint16_t* values) {
  using Narrow = std::experimental::rebind_simd_t<std::uint16_t, Float8>;
  using Wide = std::experimental::rebind_simd_t<std::uint32_t, Float8>;
  const Narrow upper(values, std::experimental::element_aligned);
  return bits8<Float8>(std::experimental::static_simd_cast<Wide>(upper) << 16);
}

/// 0, 1 ... 7.
inline Float8 count_to_8() {
  return Float8([](int k) { return static_cast<float>(k); });
}

inline void store8(float* to, Float8 v) { v.copy_to(to, std::experimental::element_aligned); }

inline Float8 choose(Mask8 mask, Float8 a, Float8 b) {
  where(mask, b) = a;
  return b;
}

}  // namespace tyndall
