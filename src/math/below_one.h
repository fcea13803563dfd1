/// Random numbers that are left over from a choice, which must end below 1.
#pragma once

namespace tyndall {

/// The largest double that does.
inline constexpr double kBelowOne = 0x1.fffffffffffffp-1;

}  // namespace tyndall
