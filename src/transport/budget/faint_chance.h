/// Roulette for light that hardly shows.
#pragma once

#include <algorithm>

namespace tyndall {

/// The probability with which light is looked for that is expected to be a `share` of what it would be at best: below a tenth
/// it hardly shows, and what is dark is dear to march through (docs/measurements.md). What is expected is known coarsely: what
/// there is more of must still be found, with a bounded weight.
inline float faint_chance(float share) {
  constexpr float kFaint = 0.1f, kLeast = 1 / 16.0f;
  return std::min(1.0f, std::max(kLeast, share / kFaint));
}

}  // namespace tyndall
