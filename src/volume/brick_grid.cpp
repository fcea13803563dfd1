#include "volume/brick_grid.h"

#include <algorithm>
#include <array>

namespace tyndall {

std::uint32_t BrickGrid::brick_at(const Index3& cell) const {
  if (!directory_.empty()) {
    const auto at = [&](std::size_t axis) { return static_cast<std::uint32_t>(cell[axis] >> kBrickLog2); };
    return directory_.at(at(0), at(1), at(2)).brick;
  }
  const std::uint32_t found = leaf(root(), root_level_, cell);
  return found == kNone ? BrickStore::kNothing : nodes_[found].first;
}

/// The upper face of support() belongs to the cells below it.
Index3 BrickGrid::cell_of(const GridVec& p) const {
  Index3 cell;
  for (std::size_t i = 0; i < 3; ++i)
    cell[i] = std::min(static_cast<std::int64_t>(p.v[i]), static_cast<std::int64_t>(support_.hi.v[i]) - 1);
  return cell;
}

void BrickGrid::lookup(const GridVec& p, float* out) const {
  std::fill_n(out, channels(), 0.0f);
  if (!support_.contains(p)) return;
  const Index3 cell = cell_of(p);
  const auto offset = [&](std::size_t i) {
    return static_cast<float>(p.v[i] - static_cast<double>(cell[i] & ~std::int64_t{7}));
  };
  bricks_.lookup_all(brick_at(cell), offset(0), offset(1), offset(2), out);
}

float BrickGrid::lookup_by_tree(const Line& line, double t) const {
  float out[kMaxChannels] = {};
  lookup(line.at(t), out);
  return out[0];
}

float BrickGrid::block_mean_by_tree(const Line& line, double t) const {
  float out[kMaxChannels] = {};
  block_mean(line.at(t), out);
  return out[0];
}

void BrickGrid::block_mean(const GridVec& p, float* out) const {
  std::fill_n(out, channels(), 0.0f);
  if (empty() || !support_.contains(p)) return;
  const Index3 cell = cell_of(p);
  const auto inside = [&](std::size_t i) { return static_cast<unsigned>(cell[i]) & 7u; };
  const std::size_t block = BlockMeans::block_of(inside(0), inside(1), inside(2));
  const std::uint32_t brick = brick_at(cell), slot = bricks_.slot(brick);
  for (int c = 0; c < channels(); ++c)
    out[c] = slot == 0 ? bricks_.constant(brick, c) : block_means_.mean(bricks_.plane(brick, c).number, block);
}

ValueRange BrickGrid::range(int channel) const {
  if (empty()) return {};
  const ValueRange r = ranges_[static_cast<std::size_t>(channel)];
  return {std::min(r.min, 0.0f), std::max(r.max, 0.0f), r.mean};
}

std::size_t BrickGrid::memory_bytes() const {
  return nodes_.capacity() * sizeof(Node) + ranges_.capacity() * sizeof(ValueRange) + bricks_.memory_bytes() +
         block_means_.memory_bytes() + octants_.memory_bytes() + directory_.memory_bytes();
}

}  // namespace tyndall
