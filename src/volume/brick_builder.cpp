#include "volume/brick_builder.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tyndall {

namespace {

constexpr int kSide = BrickGrid::kVoxelSide;
constexpr std::size_t kVoxels = BrickGrid::kVoxels;
/// Interpolation rounds a few times; ranges are widened by this much of their magnitude.
constexpr float kWiden = 0x1p-21f;

float wider_max(float v) { return v + std::abs(v) * kWiden; }
float wider_min(float v) { return v - std::abs(v) * kWiden; }

/// Weight of a voxel layer in the mean over the 8 cells of an axis: the outer ones belong to one cell only.
constexpr double layer_weight(int i) { return i == 0 || i == kSide - 1 ? 0.5 : 1.0; }

/// 16-bit steps over [low, high]; 0 is one of the steps when it lies between.
BrickGrid::Decode quantiser(float low, float high) {
  if (low >= 0) return {low, static_cast<float>((double{high} - low) / 65535)};
  const auto step = static_cast<float>((double{high} - low) / 65534);
  if (high < 0 || step == 0) return {low, step};
  const auto below = static_cast<float>(std::ceil(-double{low} / step));
  return {-(below * step), step};
}

}  // namespace

/// Builds the tree top down: every node gets the blocks that reach into it, and what has one value ends the descent.
class BrickGridBuilder {
 public:
  BrickGridBuilder(const VoxelSource& source, const BrickBuildOptions& options) : source_(source), options_(options) {
    grid_.channels_ = source.channels();
    grid_.quantised_ = !options.float_bricks;
    channels_ = static_cast<std::size_t>(grid_.channels_);
    voxels_.resize(kVoxels * channels_);
    add_slot();  // slot 0: all zero, for bricks of one value
  }

  BrickGrid build() {
    std::vector<const VoxelBlock*> blocks;
    VoxelBox all;
    for (const VoxelBlock& block : source_.blocks()) {
      const VoxelBox box = clipped(block);
      if (box.empty()) continue;
      blocks.push_back(&block);
      all.expand(box);
    }
    if (all.empty()) return std::move(grid_);
    place_root(all);
    const std::optional<Built> root = build_node(grid_.root_level_, grid_.origin_, blocks);
    if (!root) return std::move(grid_);
    finish(*root);
    return std::move(grid_);
  }

 private:
  struct Built {
    BrickGrid::Node node;
    std::array<ValueRange, BrickGrid::kMaxChannels> ranges;
  };

  VoxelBox clipped(const VoxelBlock& block) const {
    return options_.rules.clip ? block.box.intersect(*options_.rules.clip) : block.box;
  }

  /// Cells that reach a voxel begin one below it.
  void place_root(const VoxelBox& all) {
    for (std::size_t i = 0; i < 3; ++i) {
      grid_.origin_[i] = (all.lo[i] - 1) & ~std::int64_t{7};
      while (grid_.origin_[i] + BrickGrid::extent(grid_.root_level_) < all.hi[i] + 1) ++grid_.root_level_;
    }
  }

  void finish(const Built& root) {
    // The root comes first; children were numbered from 1 on.
    grid_.nodes_.insert(grid_.nodes_.begin(), root.node);
    for (BrickGrid::Node& node : grid_.nodes_)
      if (node.mask != 0) ++node.first;
    grid_.ranges_.insert(grid_.ranges_.begin(), root.ranges.begin(), root.ranges.begin() + grid_.channels_);
    grid_.nodes_.shrink_to_fit();
    grid_.ranges_.shrink_to_fit();
    grid_.bricks_.shrink_to_fit();
    grid_.decodes_.shrink_to_fit();
    grid_.steps_.shrink_to_fit();
    grid_.floats_.shrink_to_fit();
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      grid_.support_.lo[i] = static_cast<double>(non_zero_.lo[axis] - 1 - grid_.origin_[axis]);
      grid_.support_.hi[i] = static_cast<double>(non_zero_.hi[axis] + 1 - grid_.origin_[axis]);
    }
  }

  /// `blocks` reach into the node's voxels, the layer shared with the next node included.
  std::optional<Built> build_node(int level, const Index3& origin, const std::vector<const VoxelBlock*>& blocks) {
    const VoxelBox box = voxel_box(level, origin);
    if (blocks.empty()) return std::nullopt;
    const VoxelBlock& last = *blocks.back();
    if (last.leaf == VoxelBlock::kConstant && clipped(last).contains(box)) return constant_leaf(last, box);
    if (level == 0) return build_brick(origin, box, blocks);
    return build_children(level, origin, blocks);
  }

  static VoxelBox voxel_box(int level, const Index3& origin) {
    const std::int64_t size = BrickGrid::extent(level);
    return {origin, {origin[0] + size, origin[1] + size, origin[2] + size}};
  }

  std::optional<Built> build_children(int level, const Index3& origin, const std::vector<const VoxelBlock*>& blocks) {
    const std::array<std::vector<const VoxelBlock*>, 64> shares = distribute(level, origin, blocks);
    std::array<std::optional<Built>, 64> children;
    const std::int64_t size = BrickGrid::extent(level - 1);
    for (std::size_t i = 0; i < 64; ++i) {
      const auto slot = static_cast<std::int64_t>(i);
      const Index3 corner{origin[0] + (slot & 3) * size, origin[1] + (slot >> 2 & 3) * size, origin[2] + (slot >> 4) * size};
      children[i] = build_node(level - 1, corner, shares[i]);
    }
    if (std::optional<Built> one = collapse(children)) return one;
    return adopt(children);
  }

  std::array<std::vector<const VoxelBlock*>, 64> distribute(int level, const Index3& origin,
                                                            const std::vector<const VoxelBlock*>& blocks) const {
    std::array<std::vector<const VoxelBlock*>, 64> shares;
    const std::int64_t size = BrickGrid::extent(level - 1);
    for (const VoxelBlock* block : blocks) {
      const VoxelBox box = clipped(*block);
      std::array<std::int64_t, 3> from, to;
      for (std::size_t a = 0; a < 3; ++a) {
        // A voxel on the lower face of a child belongs to the child below as well.
        from[a] = std::clamp<std::int64_t>((box.lo[a] - 1 - origin[a]) >= 0 ? (box.lo[a] - 1 - origin[a]) / size : 0, 0, 3);
        to[a] = std::clamp<std::int64_t>((box.hi[a] - origin[a]) / size, -1, 3);
      }
      for (std::int64_t z = from[2]; z <= to[2]; ++z)
        for (std::int64_t y = from[1]; y <= to[1]; ++y)
          for (std::int64_t x = from[0]; x <= to[0]; ++x) shares[static_cast<std::size_t>(x + 4 * y + 16 * z)].push_back(block);
    }
    return shares;
  }

  /// 64 children of one and the same value are one leaf.
  std::optional<Built> collapse(const std::array<std::optional<Built>, 64>& children) const {
    for (const std::optional<Built>& child : children) {
      if (!child || child->node.mask != 0 || grid_.bricks_[child->node.first] != 0) return std::nullopt;
      for (std::size_t c = 0; c < channels_; ++c)
        if (low_of(*child, c) != low_of(*children[0], c)) return std::nullopt;
    }
    return children[0];
  }
  float low_of(const Built& leaf, std::size_t channel) const {
    return grid_.decodes_[leaf.node.first * channels_ + channel].low;
  }

  std::optional<Built> adopt(const std::array<std::optional<Built>, 64>& children) {
    Built parent;
    parent.node.first = static_cast<std::uint32_t>(grid_.nodes_.size());
    std::array<double, BrickGrid::kMaxChannels> mean{};
    for (std::size_t i = 0; i < 64; ++i) {
      if (!children[i]) continue;
      for (std::size_t c = 0; c < channels_; ++c) {
        const ValueRange& range = children[i]->ranges[c];
        ValueRange& sum = parent.ranges[c];
        sum = parent.node.mask == 0 ? range : ValueRange{std::min(sum.min, range.min), std::max(sum.max, range.max), 0};
        mean[c] += range.mean;
      }
      parent.node.mask |= std::uint64_t{1} << i;
      grid_.nodes_.push_back(children[i]->node);
      grid_.ranges_.insert(grid_.ranges_.end(), children[i]->ranges.begin(), children[i]->ranges.begin() + grid_.channels_);
    }
    if (parent.node.mask == 0) return std::nullopt;
    for (std::size_t c = 0; c < channels_; ++c) {
      ValueRange& sum = parent.ranges[c];
      sum.mean = static_cast<float>(mean[c] / 64);
      if (parent.node.mask != ~std::uint64_t{0}) sum = {std::min(sum.min, 0.0f), std::max(sum.max, 0.0f), sum.mean};
    }
    return parent;
  }

  // ----------------------------------------------------------------------------------------------- bricks

  float ruled(float value) const {
    if (!std::isfinite(value)) return 0;  // an error unless options_.rules.sanitize, raised by the caller
    return value < 0 && options_.rules.negative_to_zero ? 0 : value;
  }

  std::optional<Built> constant_leaf(const VoxelBlock& block, const VoxelBox& box) {
    std::array<float, BrickGrid::kMaxChannels> value{};
    bool zero = true;
    for (std::size_t c = 0; c < channels_; ++c) {
      value[c] = ruled(block.value[c]);
      zero = zero && value[c] == 0;
    }
    if (zero) return std::nullopt;
    non_zero_.expand(box);
    return add_constant(value.data());
  }

  Built add_constant(const float* value) {
    Built built;
    built.node.first = static_cast<std::uint32_t>(grid_.bricks_.size());
    grid_.bricks_.push_back(0);
    for (std::size_t c = 0; c < channels_; ++c) {
      grid_.decodes_.push_back({value[c], 0});
      built.ranges[c] = {value[c], value[c], value[c]};
    }
    return built;
  }

  std::optional<Built> build_brick(const Index3& origin, const VoxelBox& box, const std::vector<const VoxelBlock*>& blocks) {
    gather(box, blocks);
    bool zero = true, constant = true;
    for (std::size_t c = 0; c < channels_; ++c) {
      const float* first = voxels_.data() + c * kVoxels;
      zero = zero && std::all_of(first, first + kVoxels, [](float v) { return v == 0; });
      constant = constant && std::all_of(first, first + kVoxels, [&](float v) { return v == *first; });
    }
    if (zero) return std::nullopt;
    note_non_zero(origin);
    if (constant) {
      std::array<float, BrickGrid::kMaxChannels> value{};
      for (std::size_t c = 0; c < channels_; ++c) value[c] = voxels_[c * kVoxels];
      return add_constant(value.data());
    }
    return encode();
  }

  /// The 9^3 voxels of a brick from the blocks that reach into it.
  void gather(const VoxelBox& box, const std::vector<const VoxelBlock*>& blocks) {
    std::fill(voxels_.begin(), voxels_.end(), 0.0f);
    for (const VoxelBlock* block : blocks) {
      const VoxelBox part = clipped(*block).intersect(box);
      if (part.empty()) continue;
      const Index3& lo = block->box.lo;
      const float* leaf = block->leaf == VoxelBlock::kConstant ? nullptr : leaf_values(block->leaf);
      const auto run = static_cast<std::size_t>(part.hi[0] - part.lo[0] + 1);
      for (std::size_t c = 0; c < channels_; ++c)
        for (std::int64_t z = part.lo[2]; z <= part.hi[2]; ++z)
          for (std::int64_t y = part.lo[1]; y <= part.hi[1]; ++y) {
            const std::int64_t from = ((z - lo[2]) * 8 + (y - lo[1])) * 8 + (part.lo[0] - lo[0]);
            const std::int64_t to = ((z - box.lo[2]) * kSide + (y - box.lo[1])) * kSide + (part.lo[0] - box.lo[0]);
            float* out = voxels_.data() + c * kVoxels + static_cast<std::size_t>(to);
            if (leaf)
              std::copy_n(leaf + c * VoxelSource::kLeafVoxels + static_cast<std::size_t>(from), run, out);
            else
              std::fill_n(out, run, ruled(block->value[c]));
          }
    }
  }

  /// A leaf reaches into up to 8 bricks which follow each other closely: keep the last ones.
  const float* leaf_values(std::uint32_t leaf) {
    CachedLeaf& cached = leaf_cache_[leaf % kCachedLeaves];
    if (cached.leaf != leaf) {
      cached.leaf = leaf;
      cached.values.resize(VoxelSource::kLeafVoxels * channels_);
      source_.read_leaf(leaf, cached.values.data());
      for (float& value : cached.values) value = ruled(value);
    }
    return cached.values.data();
  }

  void note_non_zero(const Index3& origin) {
    int lo[3] = {kSide, kSide, kSide}, hi[3] = {-1, -1, -1};
    for (std::size_t c = 0; c < channels_; ++c)
      for (int z = 0; z < kSide; ++z)
        for (int y = 0; y < kSide; ++y)
          for (int x = 0; x < kSide; ++x) {
            if (voxels_[c * kVoxels + static_cast<std::size_t>((z * kSide + y) * kSide + x)] == 0) continue;
            const int at[3] = {x, y, z};
            for (int i = 0; i < 3; ++i) {
              lo[i] = std::min(lo[i], at[i]);
              hi[i] = std::max(hi[i], at[i]);
            }
          }
    non_zero_.expand({{origin[0] + lo[0], origin[1] + lo[1], origin[2] + lo[2]}, {origin[0] + hi[0], origin[1] + hi[1], origin[2] + hi[2]}});
  }

  std::uint32_t add_slot() {
    const std::size_t count = kVoxels * channels_;
    const std::size_t slot = (grid_.quantised_ ? grid_.steps_.size() : grid_.floats_.size()) / count;
    if (grid_.quantised_)
      grid_.steps_.resize(grid_.steps_.size() + count, 0);
    else
      grid_.floats_.resize(grid_.floats_.size() + count, 0.0f);
    return static_cast<std::uint32_t>(slot);
  }

  Built encode() {
    Built built;
    built.node.first = static_cast<std::uint32_t>(grid_.bricks_.size());
    const std::uint32_t slot = add_slot();
    grid_.bricks_.push_back(slot);
    for (std::size_t c = 0; c < channels_; ++c) {
      float* voxels = voxels_.data() + c * kVoxels;
      const std::size_t to = (slot * channels_ + c) * kVoxels;
      if (grid_.quantised_) {
        quantise(voxels, grid_.steps_.data() + to);
      } else {
        std::copy_n(voxels, kVoxels, grid_.floats_.data() + to);
        grid_.decodes_.push_back({0, 1});
      }
      built.ranges[c] = decoded_range(voxels);
    }
    return built;
  }

  /// Stores the steps and leaves the decoded values in `voxels`.
  void quantise(float* voxels, std::uint16_t* steps) {
    const auto [low, high] = std::minmax_element(voxels, voxels + kVoxels);
    const BrickGrid::Decode decode = quantiser(*low, *high);
    const double inverse = decode.step > 0 ? 1 / double{decode.step} : 0;
    for (std::size_t i = 0; i < kVoxels; ++i) {
      const double q = (double{voxels[i]} - decode.low) * inverse + 0.5;  // never below 0: truncation rounds down
      steps[i] = static_cast<std::uint16_t>(std::min(q, 65535.0));
      voxels[i] = decode.low + decode.step * static_cast<float>(steps[i]);
    }
    grid_.decodes_.push_back(decode);
  }

  static ValueRange decoded_range(const float* voxels) {
    const auto [low, high] = std::minmax_element(voxels, voxels + kVoxels);
    double sum = 0;
    for (int z = 0, i = 0; z < kSide; ++z)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x, ++i) sum += layer_weight(x) * layer_weight(y) * layer_weight(z) * voxels[i];
    return {wider_min(*low), wider_max(*high), static_cast<float>(sum / 512)};
  }

  const VoxelSource& source_;
  BrickBuildOptions options_;
  std::size_t channels_ = 1;
  BrickGrid grid_;
  VoxelBox non_zero_;
  std::vector<float> voxels_;
  struct CachedLeaf {
    std::uint32_t leaf = VoxelBlock::kConstant;
    std::vector<float> values;
  };
  static constexpr std::uint32_t kCachedLeaves = 1024;
  std::vector<CachedLeaf> leaf_cache_ = std::vector<CachedLeaf>(kCachedLeaves);
};

BrickGrid build_brick_grid(const VoxelSource& source, const BrickBuildOptions& options) {
  return BrickGridBuilder(source, options).build();
}

}  // namespace tyndall
