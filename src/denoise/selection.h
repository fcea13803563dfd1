/// Which of several filters to believe, and how far: by their errors as the two halves tell them.
#pragma once

#include "denoise/collaborative.h"
#include "denoise/judged_error.h"

namespace tyndall {

/// Of the bandwidths the one with the smaller estimated error, mixed with the unfiltered mean as far as that lessens the error:
/// with ever more samples the result is the mean.
struct Selection {
  const PaddedPlane& weight;                ///< of a pixel's squared error beside its neighbours': relative_weight
  int noise_radius;                         ///< over which variance is pooled
  const PaddedPlane* unfiltered = nullptr;  ///< 1 where the result is the mean in any case

  LightEstimate operator()(const Halves& halves, FilteredHalves filtered, ThreadPool& pool) const;
};

}  // namespace tyndall
