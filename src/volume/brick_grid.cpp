#include "volume/brick_grid.h"

#include <algorithm>

namespace tyndall {

void BrickGrid::lookup(const Vec3d& p, float* out) const {
  std::fill_n(out, channels(), 0.0f);
  if (empty() || !support_.contains(p)) return;
  const Index3 cell{static_cast<std::int64_t>(p[0]), static_cast<std::int64_t>(p[1]), static_cast<std::int64_t>(p[2])};
  const std::uint32_t found = leaf(root(), root_level_, cell);
  if (found == kNone) return;
  const auto offset = [&](int axis) {
    return static_cast<float>(p[axis] - static_cast<double>(cell[static_cast<std::size_t>(axis)] & ~std::int64_t{7}));
  };
  bricks_.lookup_all(nodes_[found].first, offset(0), offset(1), offset(2), out);
}

void BrickGrid::block_mean(const Vec3d& p, float* out) const {
  std::fill_n(out, channels(), 0.0f);
  if (empty()) return;
  const std::int64_t last = extent(root_level_) - 1;
  const auto cell_of = [&](int axis) { return std::min(static_cast<std::int64_t>(p[axis]), last); };
  const Index3 cell{cell_of(0), cell_of(1), cell_of(2)};
  const std::uint32_t found = leaf(root(), root_level_, cell);
  if (found == kNone) return;
  const auto inside = [&](std::size_t axis) { return static_cast<unsigned>(cell[axis]) & 7u; };
  const std::size_t block = BlockMeans::block_of(inside(0), inside(1), inside(2));
  const std::span<const ValueRange> in_brick = ranges(found);
  const std::uint32_t slot = bricks_.slot(nodes_[found].first);
  for (int c = 0; c < channels(); ++c) out[c] = block_means_.mean(slot, c, block, in_brick[static_cast<std::size_t>(c)]);
}

ValueRange BrickGrid::range(int channel) const {
  if (empty()) return {};
  const ValueRange r = ranges_[static_cast<std::size_t>(channel)];
  return {std::min(r.min, 0.0f), std::max(r.max, 0.0f), r.mean};
}

std::size_t BrickGrid::memory_bytes() const {
  return nodes_.capacity() * sizeof(Node) + ranges_.capacity() * sizeof(ValueRange) + bricks_.memory_bytes() +
         block_means_.memory_bytes();
}

}  // namespace tyndall
