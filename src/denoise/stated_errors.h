/// The squared error that is expected of a denoised picture.
#pragma once

#include "denoise/light.h"

namespace tyndall {

/// All components together: they have noise and bias in common, so that their errors do not just add up.
struct AllLight {
  AllLight(int width, int height);

  /// Before fireflies are given back and energy is restored.
  void add(const Halves& rendered_part, const LightEstimate& filtered_part);

  Halves rendered;         ///< without fireflies
  LightEstimate filtered;  ///< as add() has it; its `values` are the picture as it ends up
  ColorPlanes rare;        ///< squared errors of what was taken out
};

/// By pixel and channel. `weight`: relative_weight, by which errors were judged before.
ColorPlanes stated_errors(AllLight light, const PaddedPlane& weight, ThreadPool& pool);

}  // namespace tyndall
