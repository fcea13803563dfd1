/// Random sparse voxels and their plainest possible look-up, to hold grids against.
#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "math/rng.h"
#include "volume/affine.h"
#include "volume/voxel_source.h"

namespace tyndall::test {

/// Leaves and tiles given one by one; the oracle keeps every voxel of them in a map.
class OracleSource : public VoxelSource {
 public:
  explicit OracleSource(int channels = 1) : channels_(channels) {}

  void add_tile(const Index3& lo, const Index3& hi, float value) {
    VoxelBlock block{{lo, hi}, VoxelBlock::kConstant, {}};
    for (int c = 0; c < channels_; ++c) block.value[static_cast<std::size_t>(c)] = value * static_cast<float>(c + 1);
    blocks_.push_back(block);
  }
  /// Values of `draw(x, y, z)`, times c + 1 in channel c, in the leaf at `lo`, a multiple of 8.
  template <typename Draw>
  void add_leaf(const Index3& lo, const Draw& draw) {
    blocks_.push_back({{lo, {lo[0] + 7, lo[1] + 7, lo[2] + 7}}, static_cast<std::uint32_t>(leaves_.size()), {}});
    std::vector<float> values;
    for (std::int64_t z = 0; z < 8; ++z)
      for (std::int64_t y = 0; y < 8; ++y)
        for (std::int64_t x = 0; x < 8; ++x) values.push_back(draw(lo[0] + x, lo[1] + y, lo[2] + z));
    leaves_.push_back(values);
  }

  int channels() const override { return channels_; }
  const std::vector<VoxelBlock>& blocks() const override { return blocks_; }
  void read_leaf(std::uint32_t leaf, float* out) const override {
    for (int c = 0; c < channels_; ++c)
      for (const float v : leaves_[leaf]) *out++ = v * static_cast<float>(c + 1);
  }

  double voxel(const Index3& at, int channel = 0) const {
    for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block) {
      if (!block->box.contains({at, at})) continue;
      if (block->leaf == VoxelBlock::kConstant) return block->value[static_cast<std::size_t>(channel)];
      const Index3& lo = block->box.lo;
      const auto i = static_cast<std::size_t>(((at[2] - lo[2]) * 8 + at[1] - lo[1]) * 8 + at[0] - lo[0]);
      return double{leaves_[block->leaf][i]} * (channel + 1);
    }
    return 0;
  }
  /// Trilinear at an index-space point.
  double lookup(const GridVec& p, int channel = 0) const {
    Index3 base;
    double f[3];
    for (std::size_t i = 0; i < 3; ++i) {
      base[i] = static_cast<std::int64_t>(std::floor(p.v[i]));
      f[i] = p.v[i] - static_cast<double>(base[i]);
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      Index3 at = base;
      double weight = 1;
      for (std::size_t i = 0; i < 3; ++i) {
        const bool upper = corner >> i & 1;
        at[i] += upper ? 1 : 0;
        weight *= upper ? f[i] : 1 - f[i];
      }
      if (weight > 0) sum += weight * voxel(at, channel);
    }
    return sum;
  }

 private:
  int channels_;
  std::vector<VoxelBlock> blocks_;
  std::vector<std::vector<float>> leaves_;
};

/// A few leaves of smooth or noisy values and a tile, around `corner`.
inline OracleSource random_voxels(std::uint64_t seed, const Index3& corner, int channels = 1) {
  OracleSource source(channels);
  Rng rng(seed);
  const auto leaf_corner = [&] {
    Index3 lo;
    for (std::size_t i = 0; i < 3; ++i) lo[i] = corner[i] + 8 * static_cast<std::int64_t>(rng.uniform() * 6);
    return lo;
  };
  const Index3 tile = leaf_corner();
  source.add_tile(tile, {tile[0] + 23, tile[1] + 15, tile[2] + 15}, 0.75f);
  for (int i = 0; i < 12; ++i) {
    const bool smooth = rng.uniform() < 0.5f;
    const float level = rng.uniform() * 4;
    source.add_leaf(leaf_corner(), [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      if (smooth) return level * (1.5f + std::sin(0.3f * static_cast<float>(x)) * std::cos(0.2f * static_cast<float>(y + z)));
      return rng.uniform() < 0.3f ? 0.0f : level * rng.uniform();
    });
  }
  return source;
}

}  // namespace tyndall::test
