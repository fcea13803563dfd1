/// A channel with a margin, so that windows around any pixel need no test for the picture's edge.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "math/parallel.h"

namespace tyndall {

/// Floats of `width` x `height` pixels and of kMargin more on each side, zero at first.
class PaddedPlane {
 public:
  /// A window's radius and a patch's, and a SIMD vector that begins at the last pixel.
  static constexpr int kMargin = 20;

  PaddedPlane() = default;
  PaddedPlane(int width, int height)
      : width_(width), height_(height), values_(static_cast<std::size_t>(stride()) * static_cast<std::size_t>(rows())) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return values_.empty(); }

  /// Pixel (0, y); y and what is added to the pointer may be up to kMargin outside.
  float* row(int y) { return values_.data() + first_of(y); }
  const float* row(int y) const { return values_.data() + first_of(y); }
  float at(int x, int y) const { return row(y)[x]; }
  float& at(int x, int y) { return row(y)[x]; }

  /// Fill the margin with the nearest pixels' values.
  void extend();

 private:
  int stride() const { return width_ + 2 * kMargin; }
  int rows() const { return height_ + 2 * kMargin; }
  std::ptrdiff_t first_of(int y) const { return static_cast<std::ptrdiff_t>(y + kMargin) * stride() + kMargin; }

  int width_ = 0, height_ = 0;
  std::vector<float> values_;
};

using ColorPlanes = std::array<PaddedPlane, 3>;

inline ColorPlanes color_planes(int width, int height) {
  return {PaddedPlane(width, height), PaddedPlane(width, height), PaddedPlane(width, height)};
}

void add_planes(ColorPlanes& sum, const ColorPlanes& part);

/// Mean over the (2 radius + 1)^2 pixels around each, those beyond the edge being the nearest; radius <= kMargin.
PaddedPlane box_mean(const PaddedPlane& plane, int radius, ThreadPool& pool);

/// That of that: pixels count for less the farther they are.
inline PaddedPlane smooth_mean(const PaddedPlane& plane, int radius, ThreadPool& pool) {
  return box_mean(box_mean(plane, radius, pool), radius, pool);
}

/// Each pixel of a new plane, margin included: value(x, y).
template <typename Value>
PaddedPlane make_plane(int width, int height, ThreadPool& pool, const Value& value) {
  PaddedPlane plane(width, height);
  pool.for_each(static_cast<std::size_t>(height), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    float* to = plane.row(y);
    for (int x = 0; x < width; ++x) to[x] = value(x, y);
  });
  plane.extend();
  return plane;
}

/// `second` in place of `first` as far as `share` says.
void mix_planes(PaddedPlane& first, const PaddedPlane& second, const PaddedPlane& share, ThreadPool& pool);

}  // namespace tyndall
