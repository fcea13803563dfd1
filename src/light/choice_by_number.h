/// Once in 2^20 times a light is chosen by its number instead of by importance: what the wide trees have in common.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tyndall {

/// Small enough that no product with a sum of weights rounds up to that sum.
inline constexpr double kBelowOne52 = 1 - 0x1p-52;

/// Weight of the choice by number.
inline constexpr double kByNumber = 0x1p-20;

inline double mixed(double by_importance, std::uint32_t lights) { return (1 - kByNumber) * by_importance + kByNumber / lights; }

/// What is left of u when the choice by number has taken its part.
inline double rest(double u) { return std::min((u - kByNumber) / (1 - kByNumber), kBelowOne52); }

}  // namespace tyndall
