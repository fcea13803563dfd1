#include "volume/block_means.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

std::uint8_t step_of(double mean, double low, double step) {
  const double steps = step > 0 ? std::round((mean - low) / step) : 0;
  return static_cast<std::uint8_t>(std::clamp(steps, mean == 0 ? 0.0 : 1.0, 255.0));
}

}  // namespace

/// Slot 0 stands for all bricks of one value; its means are never read.
BlockMeans::BlockMeans(int channels)
    : channels_(static_cast<std::size_t>(channels)), steps_(channels_ * kBlocks), scales_(channels_) {}

void BlockMeans::shrink_to_fit() {
  steps_.shrink_to_fit();
  scales_.shrink_to_fit();
}

void BlockMeans::add(const float* voxels) {
  constexpr int kY = BrickStore::kVoxelSide, kZ = kY * kY;
  for (std::size_t c = 0; c < channels_; ++c) {
    const float* channel = voxels + c * BrickStore::kVoxels;
    const auto [low, high] = std::minmax_element(channel, channel + BrickStore::kVoxels);
    const auto step = static_cast<float>((double{*high} - *low) / 255);
    scales_.push_back({*low, step});
    for (int z = 0; z < BrickStore::kSide; z += kCells)
      for (int y = 0; y < BrickStore::kSide; y += kCells)
        for (int x = 0; x < BrickStore::kSide; x += kCells)
          steps_.push_back(step_of(range_of_cells(channel + z * kZ + y * kY + x, kCells).mean, *low, step));
  }
}

}  // namespace tyndall
