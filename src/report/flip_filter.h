/// The filters of FLIP: separable, borders repeated.
#pragma once

#include <vector>

namespace tyndall {

/// One plane of floats, row by row.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// Weights at -radius .. radius.
using Kernel = std::vector<float>;

/// `plane` correlated with across(x) down(y).
Plane filtered(const Plane& plane, const Kernel& across, const Kernel& down);

/// exp(-x^2 / (2 deviation^2)), not normalised; deviation in pixels.
Kernel gaussian(double deviation, int radius);
/// Scaled to sum 1.
Kernel normalized(Kernel kernel);
/// First and second derivative of the Gaussian, scaled so that positive weights sum to 1 and negative ones to -1: at
/// most 1 for any picture in [0, 1] [Andersson et al. 2020, sec. 4.2].
Kernel edge_kernel(double deviation, int radius);
Kernel point_kernel(double deviation, int radius);

}  // namespace tyndall
