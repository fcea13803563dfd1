/// A square of pixels, and who of them share what their paths find.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "math/rng.h"
#include "tyndall/image.h"

namespace tyndall {

struct PixelPlace {
  int x, y;
};

/// Pixels of the frame in one cell of a grid that begins at its origin, whatever part of it is rendered.
class PixelBlock {
 public:
  static constexpr int kSide = 8;

  /// Of the cell that holds (x, y); its pixels that lie in `bounds`.
  PixelBlock(int x, int y, const PixelBounds& bounds) : x0_(x - x % kSide), y0_(y - y % kSide) {
    for (int v = std::max(y0_, bounds.y0); v < std::min(y0_ + kSide, bounds.y1); ++v) {
      for (int u = std::max(x0_, bounds.x0); u < std::min(x0_ + kSide, bounds.x1); ++u) pixels_[count_++] = {u, v};
    }
  }

  std::span<const PixelPlace> pixels() const { return {pixels_.data(), count_}; }

  /// In an order of its own for each sample, so that other pixels come together in each; the same in any render of the frame.
  void shuffle(std::uint64_t seed, int sample) {
    std::sort(pixels_.begin(), pixels_.begin() + static_cast<std::ptrdiff_t>(count_),
              [](PixelPlace a, PixelPlace b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    Rng rng(hash(seed, static_cast<std::uint32_t>(x0_), static_cast<std::uint32_t>(y0_), static_cast<std::uint32_t>(sample)));
    for (std::size_t i = count_; i > 1; --i) std::swap(pixels_[i - 1], pixels_[rng.next() % i]);
  }

 private:
  int x0_, y0_;
  std::array<PixelPlace, kSide * kSide> pixels_;
  std::size_t count_ = 0;
};

}  // namespace tyndall
