/// The regressions of all windows brought together: each pixel is the mean of what the fits around it say.
#pragma once

#include <array>

#include "denoise/light.h"
#include "denoise/regression.h"

namespace tyndall {

/// What one half is filtered to, guided by the other.
struct Filtered {
  ColorPlanes values;
  Plane own_share;  ///< how much of a pixel's own value is in its filtered one, in [0, 1]
};

/// Bandwidths k of the likeness.
inline constexpr std::array kBandwidths{0.5f, 1.0f};
/// By half, then by bandwidth.
using FilteredHalves = std::array<std::array<Filtered, kBandwidths.size()>, 2>;

/// Each half filtered with the weights that the other tells, so that noise and weights are independent.
FilteredHalves regress(const Halves& halves, const std::vector<const Plane*>& features, ThreadPool& pool);

}  // namespace tyndall
