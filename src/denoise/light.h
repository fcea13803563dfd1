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

/// Values, what each half alone would have given, and the squared error that is expected of light that is not filtered.
struct LightEstimate {
  LightEstimate(int width, int height)
      : values(color_planes(width, height)),
        halves{color_planes(width, height), color_planes(width, height)},
        apart(color_planes(width, height)),
        mse(color_planes(width, height)) {}

  ColorPlanes values;
  std::array<ColorPlanes, 2> halves;  ///< `values` is their mean by shares of the samples
  ColorPlanes apart;                  ///< by how much what is filtered of the first half is above that of the second
  ColorPlanes mse;
};

}  // namespace tyndall
