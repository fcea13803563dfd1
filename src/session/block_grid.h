/// The blocks of pixels that a crop touches.
#pragma once

#include "session/pixel_block.h"

namespace tyndall {

/// Cells of PixelBlocks, row by row. Those at the crop's border may lie in it in part.
class BlockGrid {
 public:
  explicit BlockGrid(const PixelBounds& crop)
      : crop_(crop),
        first_x_(crop.x0 / PixelBlock::kSide),
        first_y_(crop.y0 / PixelBlock::kSide),
        across_((crop.x1 - 1) / PixelBlock::kSide - first_x_ + 1),
        down_((crop.y1 - 1) / PixelBlock::kSide - first_y_ + 1) {}

  std::size_t size() const { return static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_); }
  int across() const { return across_; }
  /// Of the block that holds pixel (x, y) of the frame.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y / PixelBlock::kSide - first_y_) * static_cast<std::size_t>(across_) +
           static_cast<std::size_t>(x / PixelBlock::kSide - first_x_);
  }
  /// Those of its pixels that lie in the crop.
  PixelBounds pixels(std::size_t block) const {
    const int x = (first_x_ + static_cast<int>(block) % across_) * PixelBlock::kSide;
    const int y = (first_y_ + static_cast<int>(block) / across_) * PixelBlock::kSide;
    return {std::max(x, crop_.x0), std::max(y, crop_.y0), std::min(x + PixelBlock::kSide, crop_.x1),
            std::min(y + PixelBlock::kSide, crop_.y1)};
  }
  const PixelBounds& crop() const { return crop_; }

 private:
  PixelBounds crop_;
  int first_x_, first_y_, across_, down_;
};

}  // namespace tyndall
