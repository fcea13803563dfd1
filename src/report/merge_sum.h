/// Sums of the pixels of slices, and the means made of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/matte_sum.h"
#include "tyndall/image.h"

namespace tyndall {

/// The double sums behind merge_slices, which says what is summed how.
class MergeSum {
 public:
  /// Over the pixels of `box`; the channels of `header`, SampleCount, SampleWeight where slices have it, and Dof.R .. beside
  /// Variance.R ..
  MergeSum(PixelBounds box, const Image& header);

  /// A slice that lies within the box and has these channels. `samples`: in every pixel, where it has no SampleCount.
  void add(const Image& slice, int samples);

  Image result() const;  ///< windows and channels; display = data

 private:
  /// What a channel's sum is of, x the channel's value, n what the pixel weighs: SampleWeight, where that is told, else its
  /// sample count. Means over the even samples are weighed by channels with the same prefix, "Replicate.".
  enum class Rule {
    mean,          ///< n x
    surface_mean,  ///< SurfaceCount x
    volume_mean,   ///< VolumeCount x
    sum,           ///< x
    variance,      ///< n^2 x
    samples,       ///< the sample count
    weight,        ///< n
    dof,           ///< n^2 / x
  };
  struct Plane {
    std::string name;
    Rule rule;
    std::vector<double> sums;
  };

  static Rule rule_of(const std::string& channel);
  void add_plane(const std::string& name);
  /// Of a slice.
  struct Weights {
    const float *counts, *all, *even;  ///< samples; what means over all weigh, and over the even ones, null without these
  };
  void add_channel(Plane& plane, const Image& slice, const Weights& weights) const;
  const std::vector<double>* weights_of(const Plane& plane) const;
  const Plane* find(const std::string& name) const;

  /// Where pixel `i` of a slice is in the box.
  std::size_t place_in_box(const Image& slice, std::size_t i) const;

  PixelBounds box_;
  std::vector<Plane> planes_;
  bool weighted_ = false;         ///< some slice tells SampleWeight
  std::vector<MatteSum> mattes_;  ///< of the layers of the header
};

}  // namespace tyndall
