/// What errors are relative to.
#pragma once

namespace tyndall {

/// Of relMSE, mean of squared error / (mean^2 + this), in units of the picture: what is darker than a tenth counts as that.
inline constexpr double kRelativeEpsilon = 0.01;

}  // namespace tyndall
