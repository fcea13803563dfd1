/// The noise of two halves: fireflies taken out, variance pooled.
#pragma once

#include "denoise/light.h"

namespace tyndall {

/// Two halves have one degree of freedom a pixel, so that a patch of them is needed to say how noisy it is: half the variances
/// would be below 0.45 of the true one, and all weights wrong with them. `radius` of the patch in pixels.
void pool_variance(Halves& halves, int radius, ThreadPool& pool);

/// Values of one half that neither the other nor the pixels around know of give way to the mean around them: they would be
/// spread over a window, and drown its variance.
void take_out_fireflies(Halves& halves, ThreadPool& pool);

}  // namespace tyndall
