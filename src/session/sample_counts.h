/// How many samples each pixel of a film has received.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace tyndall {

/// Samples of a pixel of which the odd ones are left out.
inline int even_of(int samples) { return samples - samples / 2; }

class SampleCounts {
 public:
  SampleCounts(int everywhere) : everywhere_(everywhere) {}  // NOLINT: a number is the common case
  /// Row by row; at least one pixel.
  explicit SampleCounts(std::vector<int> by_pixel) : everywhere_(0), by_pixel_(std::move(by_pixel)) {}

  int of(std::size_t pixel) const { return by_pixel_.empty() ? everywhere_ : by_pixel_[pixel]; }
  int least() const { return by_pixel_.empty() ? everywhere_ : *std::min_element(by_pixel_.begin(), by_pixel_.end()); }
  int most() const { return by_pixel_.empty() ? everywhere_ : *std::max_element(by_pixel_.begin(), by_pixel_.end()); }

 private:
  int everywhere_;
  std::vector<int> by_pixel_;
};

}  // namespace tyndall
