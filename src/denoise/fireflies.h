/// Values that neither the other half nor the pixels around know of.
#pragma once

#include "denoise/light.h"

namespace tyndall {

/// What was taken out of two halves because it looked like fireflies.
struct Fireflies {
  ColorPlanes errors;       ///< squared, by pixel: expected of taking it out
  ColorPlanes light;        ///< that both halves lost around each pixel, a mean over the neighbourhood
  ColorPlanes differences;  ///< squared, of that mean: between what was lost in all and `light`

  /// Gives back `light` and adds to `mse`, when given, what is expected of it: to a pixel as much less as it is darker than
  /// those around, so that black stays black, but no more where one stands out.
  void give_back(ColorPlanes& filtered, ColorPlanes* mse, ThreadPool& pool) const;
};

/// Takes them out: they give way to the mean around them, since they would be spread over a window, and drown its variance.
///
/// A light that is truly there, but rarely found, looks the same. How much of it is, the other half tells, since it knows
/// nothing of what stands out in this one: E[B - around | A stands out] = q E[A - around | A stands out], where q is the chance
/// that a half finds such a light. The square of q (A - around) is stated for what is taken out.
///
/// Light that is rare everywhere in a region is found in other pixels by the other half: of what both lost around a pixel the
/// lesser is light, and a firefly alone gives none.
Fireflies take_out_fireflies(Halves& halves, ThreadPool& pool);

}  // namespace tyndall
