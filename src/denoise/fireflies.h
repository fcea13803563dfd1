/// Values that neither the other half nor the pixels around know of.
#pragma once

#include "denoise/light.h"

namespace tyndall {

/// Takes them out: they give way to the mean around them, since they would be spread over a window, and drown its variance.
/// Gives the squared error that is to be expected of that, by pixel.
///
/// A light that is truly there, but rarely found, looks the same. How much of it is, the other half tells, since it knows
/// nothing of what stands out in this one: E[B - around | A stands out] = q E[A - around | A stands out], where q is the chance
/// that a half finds such a light. The square of q (A - around) is stated for what is taken out.
ColorPlanes take_out_fireflies(Halves& halves, ThreadPool& pool);

}  // namespace tyndall
