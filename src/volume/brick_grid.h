/// A sparse grid of voxels made for rays: trilinear look-ups that touch one brick, and a hierarchy of exact bounds.
///
/// Convention: voxel (i,j,k) sits at index-space point (i,j,k), as OpenVDB's BoxSampler has it. A *cell* is the unit
/// cube between 8 voxels. A brick holds 8x8x8 cells and all 9x9x9 voxels they interpolate, so that neighbours share
/// a layer. Above the bricks stands a tree of 4x4x4 children a node. "Local" coordinates are index coordinates minus
/// origin(), never negative inside the tree.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "volume/affine.h"
#include "volume/voxel_source.h"

namespace tyndall {

/// Bounds and mean over the cells of a node of one channel. min and max hold for every interpolated look-up.
struct ValueRange {
  float min = 0, max = 0, mean = 0;
};

class BrickGrid {
 public:
  static constexpr int kBrickSide = 8, kBrickLog2 = 3, kVoxelSide = 9, kVoxels = 729;
  static constexpr int kMaxChannels = 6;
  static constexpr int kMaxLevel = 16;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Children of a node stand one after another from `first` in the order of their bits in `mask`.
  /// mask 0: a leaf, `first` is its brick; a leaf above level 0 has one value everywhere.
  struct Node {
    std::uint64_t mask = 0;
    std::uint32_t first = 0;
  };
  /// value = low + step * (interpolated stored number), per channel.
  struct Decode {
    float low = 0, step = 0;
  };

  bool empty() const { return nodes_.empty(); }
  int channels() const { return channels_; }
  int root_level() const { return root_level_; }
  std::uint32_t root() const { return 0; }
  const Index3& origin() const { return origin_; }
  /// Local coordinates outside which every look-up is 0.
  const Box3d& support() const { return support_; }
  std::size_t brick_count() const { return bricks_.size(); }
  std::size_t memory_bytes() const;
  ValueRange range(int channel = 0) const;  ///< of the whole grid, the empty surroundings included

  const Node& node(std::uint32_t index) const { return nodes_[index]; }
  std::span<const ValueRange> ranges(std::uint32_t node) const {
    return {ranges_.data() + std::size_t{node} * static_cast<std::size_t>(channels_), static_cast<std::size_t>(channels_)};
  }
  /// Edge of a node of `level` in cells.
  static constexpr std::int64_t extent(int level) { return std::int64_t{kBrickSide} << (2 * level); }
  /// Child of `node` (at `level`, not a leaf) that holds local cell (x,y,z), or kNone where it is empty.
  std::uint32_t child(std::uint32_t node, int level, const Index3& cell) const {
    const int shift = kBrickLog2 + 2 * (level - 1);
    const auto bits = [&](std::size_t axis) { return static_cast<unsigned>(cell[axis] >> shift) & 3u; };
    const unsigned slot = bits(0) | bits(1) << 2 | bits(2) << 4;
    const Node& n = nodes_[node];
    if (!(n.mask >> slot & 1)) return kNone;
    return n.first + static_cast<std::uint32_t>(std::popcount(n.mask & ((std::uint64_t{1} << slot) - 1)));
  }
  /// Leaf below `node` that holds the cell, or kNone. The cell must lie in the node.
  std::uint32_t leaf(std::uint32_t node, int level, const Index3& cell) const {
    while (node != kNone && nodes_[node].mask != 0) node = child(node, level--, cell);
    return node;
  }

  /// Trilinear values of all channels at local point `p` into `out`; 0 outside.
  void lookup(const Vec3d& p, float* out) const;
  float lookup(const Vec3d& p) const {
    float out[kMaxChannels];
    lookup(p, out);
    return out[0];
  }
  /// The same at offset (x,y,z) in [0,8] from the lower corner of a leaf's brick (any offset for a constant leaf).
  void lookup_in_leaf(std::uint32_t leaf, float x, float y, float z, float* out) const;
  float scalar_in_leaf(std::uint32_t leaf, float x, float y, float z) const;  ///< of a grid of one channel

 private:
  friend class BrickGridBuilder;
  template <typename Stored>
  static float interpolate(const Stored* voxels, const int offset, float fx, float fy, float fz);
  struct Corner;

  int channels_ = 1;
  int root_level_ = 0;
  bool quantised_ = true;
  Index3 origin_{};
  Box3d support_{{{0, 0, 0}}, {{-1, -1, -1}}};
  std::vector<Node> nodes_;
  std::vector<ValueRange> ranges_;       // channels_ a node
  std::vector<std::uint32_t> bricks_;    // slot in the voxel array of each brick; slot 0 is all zero
  std::vector<Decode> decodes_;          // channels_ a brick
  std::vector<std::uint16_t> steps_;     // channels_ * kVoxels a slot, x fastest
  std::vector<float> floats_;            // instead of steps_ when not quantised
};

// ------------------------------------------------------------------------------------------- look-ups, inline

/// Cell of a coordinate in [0,8] and the fraction inside it.
struct BrickGrid::Corner {
  int cell;
  float fraction;
  explicit Corner(float x) {
    const float clamped = x > 0 ? (x < kBrickSide ? x : float{kBrickSide}) : 0.0f;
    const int i = static_cast<int>(clamped);
    cell = i < kBrickSide ? i : kBrickSide - 1;
    fraction = clamped - static_cast<float>(cell);
  }
};

template <typename Stored>
inline float BrickGrid::interpolate(const Stored* voxels, const int offset, float fx, float fy, float fz) {
  const auto at = [&](int i) { return static_cast<float>(voxels[offset + i]); };
  constexpr int kY = kVoxelSide, kZ = kVoxelSide * kVoxelSide;
  const float low[4] = {at(0), at(kY), at(kZ), at(kY + kZ)};
  const float high[4] = {at(1), at(kY + 1), at(kZ + 1), at(kY + kZ + 1)};
  float x[4];
  for (int i = 0; i < 4; ++i) x[i] = low[i] + fx * (high[i] - low[i]);
  const float y0 = x[0] + fy * (x[1] - x[0]);
  const float y1 = x[2] + fy * (x[3] - x[2]);
  return y0 + fz * (y1 - y0);
}

inline float BrickGrid::scalar_in_leaf(std::uint32_t leaf, float x, float y, float z) const {
  const Corner cx(x), cy(y), cz(z);
  const std::uint32_t brick = nodes_[leaf].first;
  const int offset = (cz.cell * kVoxelSide + cy.cell) * kVoxelSide + cx.cell;
  const std::size_t slot = std::size_t{bricks_[brick]} * kVoxels;
  const float stored = quantised_ ? interpolate(steps_.data() + slot, offset, cx.fraction, cy.fraction, cz.fraction)
                                  : interpolate(floats_.data() + slot, offset, cx.fraction, cy.fraction, cz.fraction);
  const Decode d = decodes_[brick];
  return d.low + d.step * stored;
}

}  // namespace tyndall
