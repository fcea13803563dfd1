/// The regressions of all windows brought together: each pixel is the mean of what the fits around it say.
#pragma once

#include <array>

#include "denoise/light.h"
#include "denoise/regression.h"

namespace tyndall {

/// What one half is filtered to.
struct Filtered {
  ColorPlanes values;
  PaddedPlane leverage;  ///< how much of a pixel's own value is in its filtered one, in [0, 1]
};

/// Bandwidths k of the likeness.
inline constexpr std::array kBandwidths{0.5f, 1.0f};
/// By half, then by bandwidth.
using FilteredHalves = std::array<std::array<Filtered, kBandwidths.size()>, 2>;

/// What explains each half.
using FeatureHalves = std::array<std::vector<const PaddedPlane*>, 2>;

/// Each half filtered with weights of its own, so that the other knows nothing of the result and can judge it.
FilteredHalves regress(const Halves& halves, const FeatureHalves& features, ThreadPool& pool);

}  // namespace tyndall
