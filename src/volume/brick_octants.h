/// The eighths of bricks: the last level of majorants, for the few bricks that are worth it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "volume/brick_store.h"

namespace tyndall {

/// Bounds and means over the 8 octants of 4^3 cells of each brick that has voxels.
class BrickOctants {
 public:
  static constexpr int kCells = BrickStore::kSide / 2;

  /// Slot 0 stands for all bricks of one value, which are never split.
  explicit BrickOctants(int channels = 1) : channels_(static_cast<std::size_t>(channels)), ranges_(8 * channels_) {}

  /// Append the next slot of a BrickStore, as it left it: kVoxels decoded voxels for each channel.
  void add(const float* voxels) {
    constexpr int kY = BrickStore::kVoxelSide, kZ = kY * kY;
    for (int octant = 0; octant < 8; ++octant)
      for (std::size_t c = 0; c < channels_; ++c) {
        const int corner = kCells * ((octant & 1) + (octant >> 1 & 1) * kY + (octant >> 2) * kZ);
        ranges_.push_back(range_of_cells(voxels + c * BrickStore::kVoxels + corner, kCells));
      }
  }
  /// Of all channels; bit 0, 1, 2 of `octant`: in the upper half along x, y, z.
  std::span<const ValueRange> ranges(std::uint32_t slot, unsigned octant) const {
    return {ranges_.data() + (std::size_t{slot} * 8 + octant) * channels_, channels_};
  }

  void shrink_to_fit() { ranges_.shrink_to_fit(); }
  std::size_t memory_bytes() const { return ranges_.capacity() * sizeof(ValueRange); }

 private:
  std::size_t channels_;
  std::vector<ValueRange> ranges_;  // channels_ an octant, 8 octants a slot
};

}  // namespace tyndall
