#include "volume/brick_grid.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

void BrickGrid::lookup_in_leaf(std::uint32_t leaf, float x, float y, float z, float* out) const {
  const Corner cx(x), cy(y), cz(z);
  const std::uint32_t brick = nodes_[leaf].first;
  const int offset = (cz.cell * kVoxelSide + cy.cell) * kVoxelSide + cx.cell;
  const std::size_t channels = static_cast<std::size_t>(channels_);
  for (std::size_t c = 0; c < channels; ++c) {
    const std::size_t slot = (std::size_t{bricks_[brick]} * channels + c) * kVoxels;
    const float stored = quantised_ ? interpolate(steps_.data() + slot, offset, cx.fraction, cy.fraction, cz.fraction)
                                    : interpolate(floats_.data() + slot, offset, cx.fraction, cy.fraction, cz.fraction);
    const Decode d = decodes_[brick * channels + c];
    out[c] = d.low + d.step * stored;
  }
}

void BrickGrid::lookup(const Vec3d& p, float* out) const {
  std::fill_n(out, channels_, 0.0f);
  if (empty() || !support_.contains(p)) return;
  const Index3 cell{static_cast<std::int64_t>(p[0]), static_cast<std::int64_t>(p[1]), static_cast<std::int64_t>(p[2])};
  const std::uint32_t found = leaf(root(), root_level_, cell);
  if (found == kNone) return;
  const auto offset = [&](int axis) {
    return static_cast<float>(p[axis] - static_cast<double>(cell[static_cast<std::size_t>(axis)] & ~std::int64_t{7}));
  };
  lookup_in_leaf(found, offset(0), offset(1), offset(2), out);
}

ValueRange BrickGrid::range(int channel) const {
  if (empty()) return {};
  const ValueRange r = ranges_[static_cast<std::size_t>(channel)];
  return {std::min(r.min, 0.0f), std::max(r.max, 0.0f), r.mean};
}

std::size_t BrickGrid::memory_bytes() const {
  return nodes_.capacity() * sizeof(Node) + ranges_.capacity() * sizeof(ValueRange) +
         bricks_.capacity() * sizeof(std::uint32_t) + decodes_.capacity() * sizeof(Decode) +
         steps_.capacity() * sizeof(std::uint16_t) + floats_.capacity() * sizeof(float);
}

}  // namespace tyndall
