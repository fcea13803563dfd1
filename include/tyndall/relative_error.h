/// What relative errors of pictures are relative to.
#pragma once

namespace tyndall {

/// Of relMSE, mean of squared error / (value^2 + this), in units of the picture: what is darker than a tenth counts as that,
/// and black does not divide by 0.
inline constexpr double kRelativeEpsilon = 0.01;

}  // namespace tyndall
