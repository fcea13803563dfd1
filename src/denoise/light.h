/// A component of light on its way through the denoiser.
#pragma once

#include <array>

#include "denoise/plane.h"

namespace tyndall {

/// Means over the even samples and over the odd ones.
struct Halves {
  std::array<ColorPlanes, 2> values;
  std::array<float, 2> share;  ///< of the samples; their sum is 1
  ColorPlanes variance;        ///< of the mean over all, pooled over neighbours: pool_variance

  int width() const { return values[0][0].width(); }
  int height() const { return values[0][0].height(); }
  /// Variance of the mean as this pixel alone tells it, with one degree of freedom.
  float raw_variance(std::size_t channel, int x, int y) const {
    const float difference = values[0][channel].at(x, y) - values[1][channel].at(x, y);
    return share[0] * share[1] * (difference * difference);
  }
  float mean(std::size_t channel, int x, int y) const {
    return share[0] * values[0][channel].at(x, y) + share[1] * values[1][channel].at(x, y);
  }
};

/// Values, and the squared error that is expected of them: `mse` and, over the square of the picture's brightness as
/// relative_weight() has it, `relative`.
struct LightEstimate {
  LightEstimate(int width, int height)
      : values(color_planes(width, height)), mse(color_planes(width, height)), relative(color_planes(width, height)) {}

  ColorPlanes values, mse, relative;
};

}  // namespace tyndall
