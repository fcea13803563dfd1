/// A component of light on its way through the denoiser.
#pragma once

#include <array>

#include "denoise/plane.h"

namespace tyndall {

/// Means over the even samples and over the odd ones, and the variance of the mean over all, pooled over neighbours.
struct Halves {
  std::array<ColorPlanes, 2> values;
  std::array<float, 2> share;  ///< of the samples; their sum is 1
  ColorPlanes variance;

  int width() const { return variance[0].width(); }
  int height() const { return variance[0].height(); }
  float mean(std::size_t channel, int x, int y) const {
    return share[0] * values[0][channel].at(x, y) + share[1] * values[1][channel].at(x, y);
  }
};

/// Values, and the squared error that is expected of them.
struct LightEstimate {
  ColorPlanes values, mse;
};

}  // namespace tyndall
