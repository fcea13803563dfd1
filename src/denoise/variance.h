/// The noise of two halves, pooled.
#pragma once

#include "denoise/light.h"

namespace tyndall {

/// Of the patch that noise is pooled over, but for outlines.
inline constexpr int kNoiseRadius = 3;

/// Two halves have one degree of freedom a pixel, so that a patch of them is needed to say how noisy it is: half the variances
/// would be below 0.45 of the true one, and all weights wrong with them. `radius` of the patch in pixels.
void pool_variance(Halves& halves, int radius, ThreadPool& pool);

}  // namespace tyndall
