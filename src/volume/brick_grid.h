/// A sparse grid of voxels made for rays: trilinear look-ups that touch one brick, and a hierarchy of exact bounds.
///
/// Convention: voxel (i,j,k) sits at index-space point (i,j,k), as OpenVDB's BoxSampler has it. A *cell* is the unit
/// cube between 8 voxels. A brick holds 8x8x8 cells and all 9x9x9 voxels they interpolate, so that neighbours share
/// a layer. Above the bricks stands a tree of 4x4x4 children a node. "Local" coordinates are index coordinates minus
/// origin(), never negative inside the tree.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "volume/affine.h"
#include "volume/block_means.h"
#include "volume/brick_directory.h"
#include "volume/brick_octants.h"
#include "volume/brick_store.h"
#include "volume/voxel_source.h"

namespace tyndall {

class BrickGrid {
 public:
  static constexpr int kBrickLog2 = 3;
  static constexpr int kMaxLevel = 16;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Children of a node stand one after another from `first` in the order of their bits in `mask`.
  /// mask 0: a leaf, `first` is its brick; a leaf above level 0 has one value everywhere.
  struct Node {
    std::uint64_t mask = 0;
    std::uint32_t first = 0;
    bool is_leaf() const { return mask == 0; }
  };

  bool empty() const { return nodes_.empty(); }
  int channels() const { return bricks_.channels(); }
  int root_level() const { return root_level_; }
  std::uint32_t root() const { return 0; }
  const Index3& origin() const { return origin_; }
  /// Local coordinates outside which every look-up is 0.
  const Box3d& support() const { return support_; }
  const BrickStore& bricks() const { return bricks_; }
  const BrickOctants& octants() const { return octants_; }
  std::size_t memory_bytes() const;
  ValueRange range(int channel = 0) const;  ///< of the whole grid, the empty surroundings included

  const Node& node(std::uint32_t index) const { return nodes_[index]; }
  std::span<const ValueRange> ranges(std::uint32_t node) const {
    const auto count = static_cast<std::size_t>(channels());
    return {ranges_.data() + node * count, count};
  }
  /// Edge of a node of `level` in cells.
  static constexpr std::int64_t extent(int level) { return std::int64_t{BrickStore::kSide} << (2 * level); }
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
    while (node != kNone && !nodes_[node].is_leaf()) node = child(node, level--, cell);
    return node;
  }

  /// Number of the brick that holds the cell, BrickStore::kNothing where it is empty. The cell must lie in support().
  std::uint32_t brick_at(const Index3& cell) const;
  /// Trilinear value of the first channel at t of a line in local coordinates; 0 outside.
  float lookup(const Line& line, double t) const {
    if (directory_.empty()) return lookup_by_tree(line, t);
    return read_at(line, t,
                   [&](const auto& plane, const BrickPoint& point, const auto&) { return bricks_.read(plane, point); });
  }
  /// At local point `p`.
  float lookup(const GridVec& p) const { return lookup(Line{{p[0], p[1], p[2], 0}, {}}, 0); }
  /// Of all channels, into `out`.
  void lookup(const GridVec& p, float* out) const;
  /// Means of all channels over the block of cells that holds local point `p`, rounded as BlockMeans says; 0 outside.
  void block_mean(const GridVec& p, float* out) const;
  /// Of the first channel at t of a line in local coordinates; 0 outside.
  float block_mean(const Line& line, double t) const {
    if (directory_.empty()) return block_mean_by_tree(line, t);
    return read_at(line, t, [&](const auto& plane, const BrickPoint&, const auto& cell) {
      return mean_of(plane, BlockMeans::block_of(cell[0] & 7u, cell[1] & 7u, cell[2] & 7u));
    });
  }

 private:
  friend class BrickGridBuilder;
  Index3 cell_of(const GridVec& p) const;
  /// By the directory, 0 outside: read(plane, point, cell) of the brick that holds t of a line, the point in it, and its cell.
  template <typename Read>
  float read_at(const Line& line, double t, const Read& read) const {
    std::uint32_t cell[3];
    bool inside;
    const BrickPoint point(line, t, bounds_, cell, inside);
    if (!inside) return 0;
    return read(directory_.at(cell[0] >> kBrickLog2, cell[1] >> kBrickLog2, cell[2] >> kBrickLog2).plane, point, cell);
  }
  float mean_of(const BrickStore::Plane& plane, std::size_t block) const {
    return plane.number == 0 ? plane.decode.low : block_means_.mean(plane.number, block);
  }
  float lookup_by_tree(const Line& line, double t) const;
  float block_mean_by_tree(const Line& line, double t) const;

  int root_level_ = 0;
  Index3 origin_{};
  Box3d support_{{{0, 0, 0}}, {{-1, -1, -1}}};
  CellBounds bounds_;  // support_ once more, with a directory only
  std::vector<Node> nodes_;
  std::vector<ValueRange> ranges_;  // channels() a node
  BrickStore bricks_;
  BlockMeans block_means_;
  BrickOctants octants_;
  BrickDirectory directory_;
};

}  // namespace tyndall
