/// Functions of eight numbers for weights: a few instructions each, with errors of a few parts in a million that are the same
/// on every processor.
#pragma once

#include "math/simd.h"

namespace tyndall {

using Int8 = std::experimental::rebind_simd_t<std::int32_t, Float8>;

/// 1 / sqrt(x) to 5e-6, for normal x > 0: a guess from the exponent, twice improved by Newton's method.
inline Float8 fast_rsqrt(Float8 x) {
  Float8 y = bits8<Float8>(0x5f375a86 - (bits8<Int8>(x) >> 1));
  const Float8 half = 0.5f * x;
  y *= 1.5f - half * y * y;
  y *= 1.5f - half * y * y;
  return y;
}

/// exp(-x) to 1e-5, for x in [0, 80].
inline Float8 fast_exp_minus(Float8 x) {
  const Float8 y = x * -1.44269504f;
  const Int8 whole = std::experimental::static_simd_cast<Int8>(y) - 1;      // y <= 0 is cut toward 0: down is one less
  const Float8 f = y - std::experimental::static_simd_cast<Float8>(whole);  // in (0, 1]
  // 2^f: the minimax polynomial on [0, 1], to 2.6e-6.
  const Float8 power = 1.00000259f + f * (0.693003834f + f * (0.241442757f + f * (0.0520114603f + f * 0.0135341681f)));
  return power * bits8<Float8>((whole + 127) << 23);
}

/// atan(r) / r to 5e-6 as a function of r^2 in [0, 1]: the minimax polynomial.
inline Float8 fast_atan_ratio(Float8 r2) {
  return 0.99999563f +
         r2 * (-0.332994597f + r2 * (0.195635923f + r2 * (-0.121239068f + r2 * (0.057477311f + r2 * -0.0134804688f))));
}

}  // namespace tyndall
