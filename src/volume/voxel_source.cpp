#include "volume/voxel_source.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

bool VoxelBox::contains(const VoxelBox& b) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (b.lo[i] < lo[i] || b.hi[i] > hi[i]) return false;
  return true;
}

VoxelBox VoxelBox::intersect(const VoxelBox& b) const {
  VoxelBox r;
  for (std::size_t i = 0; i < 3; ++i) {
    r.lo[i] = std::max(lo[i], b.lo[i]);
    r.hi[i] = std::min(hi[i], b.hi[i]);
  }
  return r;
}

void VoxelBox::expand(const VoxelBox& b) {
  if (b.empty()) return;
  if (empty()) {
    *this = b;
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    lo[i] = std::min(lo[i], b.lo[i]);
    hi[i] = std::max(hi[i], b.hi[i]);
  }
}

DenseSource::DenseSource(std::array<int, 3> size, std::vector<std::vector<float>> planes)
    : size_(size), planes_(std::move(planes)) {
  for (std::int64_t z = 0; z < size_[2]; z += kLeafSide)
    for (std::int64_t y = 0; y < size_[1]; y += kLeafSide)
      for (std::int64_t x = 0; x < size_[0]; x += kLeafSide) {
        VoxelBlock block;
        block.box = {{x, y, z}, {x + 7, y + 7, z + 7}};
        block.leaf = static_cast<std::uint32_t>(blocks_.size());
        blocks_.push_back(block);
      }
}

void DenseSource::read_leaf(std::uint32_t leaf, float* out) const {
  const Index3& lo = blocks_[leaf].box.lo;
  for (const std::vector<float>& plane : planes_)
    for (std::int64_t z = lo[2]; z < lo[2] + kLeafSide; ++z)
      for (std::int64_t y = lo[1]; y < lo[1] + kLeafSide; ++y)
        for (std::int64_t x = lo[0]; x < lo[0] + kLeafSide; ++x) {
          const bool inside = x < size_[0] && y < size_[1] && z < size_[2];
          *out++ = inside ? plane[static_cast<std::size_t>((z * size_[1] + y) * size_[0] + x)] : 0.0f;
        }
}

namespace {

struct Voxels {
  float value, background;
  std::int64_t count;
};

void inspect_value(const Voxels& voxels, const Index3& index, VoxelReport& report) {
  const auto [value, background, count] = voxels;
  if (value == background) return;
  if (!std::isfinite(value)) {
    if (report.non_finite == 0) report.first_non_finite = index;
    report.non_finite += count;
  } else if (value < 0) {
    report.negative += count;
    report.lowest = std::min(report.lowest, value);
  }
}

}  // namespace

VoxelReport inspect(const VoxelSource& source, const VoxelRules& rules) {
  VoxelReport report;
  const std::size_t channels = static_cast<std::size_t>(source.channels());
  std::vector<float> values(VoxelSource::kLeafVoxels * channels);
  for (const VoxelBlock& block : source.blocks()) {
    const VoxelBox box = rules.clip ? block.box.intersect(*rules.clip) : block.box;
    if (box.empty()) continue;
    if (block.leaf == VoxelBlock::kConstant) {
      const std::int64_t count = (box.hi[0] - box.lo[0] + 1) * (box.hi[1] - box.lo[1] + 1) * (box.hi[2] - box.lo[2] + 1);
      for (std::size_t c = 0; c < channels; ++c) inspect_value({block.value[c], rules.background[c], count}, box.lo, report);
      continue;
    }
    source.read_leaf(block.leaf, values.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] >= 0 && values[i] <= std::numeric_limits<float>::max()) continue;
      const auto local = static_cast<std::int64_t>(i % VoxelSource::kLeafVoxels);
      const Index3 index{block.box.lo[0] + (local & 7), block.box.lo[1] + (local >> 3 & 7), block.box.lo[2] + (local >> 6)};
      if (box.contains({index, index}))
        inspect_value({values[i], rules.background[i / VoxelSource::kLeafVoxels], 1}, index, report);
    }
  }
  return report;
}

}  // namespace tyndall
