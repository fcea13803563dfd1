/// Means over small blocks of a brick's cells, for what only chooses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "volume/brick_store.h"

namespace tyndall {

/// Means over blocks of kCells^3 cells, a byte each: 256 steps between the brick's min and max, so the error is below
/// 1/255 of that range. Rounded up from the smallest step: a mean is exactly 0 only where all voxels are.
class BlockMeans {
 public:
  /// Edge of a block. Depths along rays err two to three times as much with 4, and the grid is 4 % smaller.
  static constexpr int kCells = 2;
  static constexpr int kSide = BrickStore::kSide / kCells, kBlocks = kSide * kSide * kSide;

  /// Numbered as the slots of a BrickStore: slot 0, of all bricks of one value, is there from the start.
  explicit BlockMeans(int channels = 1) : channels_(static_cast<std::size_t>(channels)), steps_(channels_ * kBlocks, 0) {}

  /// Append a brick as BrickStore left it: kVoxels decoded voxels for each channel, and their ranges.
  void add(const float* voxels, const ChannelRanges& ranges);

  /// Number of the block that holds a cell of a brick, each coordinate in [0, 8).
  static std::size_t block_of(unsigned x, unsigned y, unsigned z) {
    return ((z / kCells * kSide) + y / kCells) * kSide + x / kCells;
  }
  /// `range` is that of the brick's node. Below range.min nowhere, above range.max nowhere.
  float mean(std::uint32_t slot, int channel, std::size_t block, const ValueRange& range) const {
    const std::size_t at = (std::size_t{slot} * channels_ + static_cast<std::size_t>(channel)) * kBlocks + block;
    return range.min + (range.max - range.min) * (static_cast<float>(steps_[at]) * (1.0f / 255));
  }

  void shrink_to_fit() { steps_.shrink_to_fit(); }
  std::size_t memory_bytes() const { return steps_.capacity(); }

 private:
  std::size_t channels_;
  std::vector<std::uint8_t> steps_;  // kBlocks a channel and slot
};

}  // namespace tyndall
