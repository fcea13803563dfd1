/// A square of pixels, whose paths share what they find.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "tyndall/scene.h"

namespace tyndall {

struct PixelPlace {
  int x, y;
};

/// All pixels, whatever part of them is rendered.
inline PixelBounds frame_of(const Film& film) { return {0, 0, film.width, film.height}; }

/// Pixels of the frame in one cell of a grid that begins at its origin, whatever part of it is rendered.
class PixelBlock {
 public:
  static constexpr int kSide = 8;  ///< more pixels find more, of which the nearest might have found most

  /// Of the cell that holds (x, y); its pixels that lie in `bounds`.
  PixelBlock(int x, int y, const PixelBounds& bounds) {
    const int x0 = x - x % kSide, y0 = y - y % kSide;
    for (int v = std::max(y0, bounds.y0); v < std::min(y0 + kSide, bounds.y1); ++v) {
      for (int u = std::max(x0, bounds.x0); u < std::min(x0 + kSide, bounds.x1); ++u) pixels_[count_++] = {u, v};
    }
  }

  std::span<const PixelPlace> pixels() const { return {pixels_.data(), count_}; }

 private:
  std::array<PixelPlace, kSide * kSide> pixels_;
  std::size_t count_ = 0;
};

}  // namespace tyndall
