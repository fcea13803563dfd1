/// The squared error of a filtered picture, as its two halves tell it.
#pragma once

#include "denoise/light.h"

namespace tyndall {

/// 1 / (light^2 + floor^2), light the mean of all components around a pixel: what dark pixels and bright ones see of an error.
PaddedPlane relative_weight(const ColorPlanes& light, ThreadPool& pool);

/// Sums over the channels, relative to the picture (relative_weight), pooled over neighbours.
struct JudgedError {
  PaddedPlane error;     ///< squared; without bias for a given filter, so it may be negative
  PaddedPlane chance;    ///< variance of `error`
  PaddedPlane variance;  ///< what of the error the filtered halves do not share: it is no less

  void mix(const JudgedError& other, const PaddedPlane& share, ThreadPool& pool);
};

/// What each half alone is filtered to; the picture is their mean by the halves' shares of the samples.
using Filters = std::array<const ColorPlanes*, 2>;

/// Each filtered half is judged by the other half, which knows nothing of it [Rousselle et al. 2012].
JudgedError judge(const Halves& halves, const Filters& filtered, const PaddedPlane& weight, ThreadPool& pool);

/// What is to be expected of a pixel's error, at least its variance.
PaddedPlane expected_error(const JudgedError& judged, ThreadPool& pool);

/// Sum over the channels of `squares`, relative to the picture and pooled as judged errors are.
PaddedPlane pooled_relative(const ColorPlanes& squares, const PaddedPlane& weight, ThreadPool& pool);

}  // namespace tyndall
