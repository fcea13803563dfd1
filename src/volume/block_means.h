/// Means over small blocks of a brick's cells, for choices only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "volume/brick_store.h"

namespace tyndall {

/// Means over blocks of kCells^3 cells, a byte each: 256 steps between the brick's extremes, so the error is below
/// 1/255 of that range. Rounded up to the first step: a mean is exactly 0 only where all voxels are.
class BlockMeans {
 public:
  /// Edge of a block. With larger ones optical depths along rays err more, and little memory is saved (docs/measurements.md).
  static constexpr int kCells = 2;
  static constexpr int kSide = BrickStore::kSide / kCells, kBlocks = kSide * kSide * kSide;
  static constexpr std::size_t kBytes = kBlocks + 2 * sizeof(float);  ///< a channel and slot

  explicit BlockMeans(int channels = 1);

  /// Append the next slot of a BrickStore, as it left it: kVoxels decoded voxels for each channel.
  void add(const float* voxels);

  /// Number of the block that holds a cell of a brick, each coordinate in [0, 8).
  static std::size_t block_of(unsigned x, unsigned y, unsigned z) {
    return (z / kCells * kSide + y / kCells) * kSide + x / kCells;
  }
  /// By the number of a BrickStore::Plane, of a brick that has a slot of its own; between the extremes of its voxels.
  float mean(std::size_t plane, std::size_t block) const {
    const Scale& scale = scales_[plane];
    return scale.low + scale.step * static_cast<float>(steps_[plane * kBlocks + block]);
  }

  void shrink_to_fit();
  std::size_t memory_bytes() const { return steps_.capacity() + scales_.capacity() * sizeof(Scale); }

 private:
  std::size_t channels_;
  struct Scale {
    float low = 0, step = 0;
  };
  std::vector<std::uint8_t> steps_;  // kBlocks a channel and slot
  std::vector<Scale> scales_;        // one a channel and slot
};

}  // namespace tyndall
