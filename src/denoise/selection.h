/// Which of several filters to believe, and how far: by their errors as the two halves tell them.
#pragma once

#include "denoise/collaborative.h"
#include "denoise/light.h"

namespace tyndall {

/// Of the bandwidths the one with the smaller estimated error, mixed with the unfiltered mean as far as that lessens the error:
/// with ever more samples the result is the mean.
struct Selection {
  const PaddedPlane& weight;                ///< of a pixel's squared error beside its neighbours': relative_weight
  int noise_radius;                         ///< over which variance is pooled
  const PaddedPlane* unfiltered = nullptr;  ///< 1 where the result is the mean in any case
  bool states_errors = true;                ///< else those of the result are 0

  LightEstimate operator()(const Halves& halves, const FilteredHalves& filtered, ThreadPool& pool) const;
};

/// 1 / (light^2 + floor^2), light the mean of all components around a pixel: what dark pixels and bright ones see of an error.
PaddedPlane relative_weight(const ColorPlanes& light, ThreadPool& pool);

}  // namespace tyndall
