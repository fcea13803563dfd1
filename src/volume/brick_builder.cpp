#include "volume/brick_builder.h"

#include <algorithm>
#include <optional>

#include "volume/leaf_cache.h"

namespace tyndall {

namespace {

constexpr int kSide = BrickStore::kVoxelSide;
constexpr std::size_t kVoxels = BrickStore::kVoxels;

using Blocks = std::vector<const VoxelBlock*>;

}  // namespace

/// Builds the tree top down: every node gets the blocks that reach into it, and what has one value ends the descent.
class BrickGridBuilder {
 public:
  BrickGridBuilder(const VoxelSource& source, const BrickBuildOptions& options)
      : source_(source),
        options_(options),
        channels_(static_cast<std::size_t>(source.channels())),
        voxels_(kVoxels * channels_),
        leaves_(source, options.rules) {
    grid_.bricks_ = BrickStore(source.channels(), options.float_bricks);
    grid_.block_means_ = BlockMeans(source.channels());
    grid_.octants_ = BrickOctants(source.channels());
  }

  BrickGrid build() {
    Blocks blocks;
    VoxelBox all;
    for (const VoxelBlock& block : source_.blocks()) {
      const VoxelBox box = clipped(block);
      if (box.empty()) continue;
      blocks.push_back(&block);
      all.expand(box);
    }
    if (all.empty()) return std::move(grid_);
    place_root(all);
    if (const std::optional<Built> root = build_node(grid_.root_level_, grid_.origin_, blocks)) finish(*root);
    return std::move(grid_);
  }

 private:
  struct Built {
    BrickGrid::Node node;
    ChannelRanges ranges;
  };
  using Children = std::array<std::optional<Built>, 64>;

  void take(std::size_t bytes) {
    taken_ += bytes;
    if (taken_ > options_.most_memory) throw GridTooLarge{};
  }

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

  /// The root comes first; the nodes below it were numbered without it.
  void finish(const Built& root) {
    grid_.nodes_.insert(grid_.nodes_.begin(), root.node);
    for (BrickGrid::Node& node : grid_.nodes_)
      if (!node.is_leaf()) ++node.first;
    grid_.ranges_.insert(grid_.ranges_.begin(), root.ranges.begin(), root.ranges.begin() + grid_.channels());
    grid_.nodes_.shrink_to_fit();
    grid_.ranges_.shrink_to_fit();
    grid_.bricks_.shrink_to_fit();
    grid_.block_means_.shrink_to_fit();
    grid_.octants_.shrink_to_fit();
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      grid_.support_.lo[i] = static_cast<double>(non_zero_.lo[axis] - 1 - grid_.origin_[axis]);
      grid_.support_.hi[i] = static_cast<double>(non_zero_.hi[axis] + 1 - grid_.origin_[axis]);
    }
    fill_directory();
  }

  void fill_directory() {
    BrickDirectory::Size size;
    for (std::size_t i = 0; i < 3; ++i) size[i] = ((non_zero_.hi[i] - grid_.origin_[i]) >> BrickGrid::kBrickLog2) + 1;
    grid_.directory_ = BrickDirectory(size, grid_.bricks_.size(), entry(BrickStore::kNothing));
    if (grid_.directory_.empty()) return;
    for (std::size_t i = 0; i < 3; ++i) {
      grid_.bounds_.lo[i] = grid_.support_.lo.v[i];
      grid_.bounds_.hi[i] = grid_.support_.hi.v[i];
      grid_.bounds_.last[i] = static_cast<std::int32_t>(grid_.support_.hi.v[i]) - 1;
    }
    enter_node(grid_.root(), grid_.root_level_, {0, 0, 0});
  }

  BrickDirectory::Entry entry(std::uint32_t brick) const { return {brick, grid_.bricks_.plane(brick, 0)}; }

  /// `corner` in bricks.
  void enter_node(std::uint32_t number, int level, const BrickDirectory::Size& corner) {
    const BrickGrid::Node node = grid_.nodes_[number];
    const std::int64_t side = std::int64_t{1} << (2 * level);
    if (node.is_leaf()) {
      std::uint32_t end[3];
      for (std::size_t i = 0; i < 3; ++i)
        end[i] = static_cast<std::uint32_t>(std::min<std::int64_t>(corner[i] + side, grid_.directory_.size(i)));
      for (auto z = static_cast<std::uint32_t>(corner[2]); z < end[2]; ++z)
        for (auto y = static_cast<std::uint32_t>(corner[1]); y < end[1]; ++y)
          for (auto x = static_cast<std::uint32_t>(corner[0]); x < end[0]; ++x)
            grid_.directory_.set(x, y, z, entry(node.first));
      return;
    }
    std::uint32_t child = node.first;
    for (std::int64_t slot = 0; slot < 64; ++slot) {
      if (!(node.mask >> slot & 1)) continue;
      const BrickDirectory::Size at{corner[0] + (slot & 3) * side / 4, corner[1] + (slot >> 2 & 3) * side / 4,
                                    corner[2] + (slot >> 4) * side / 4};
      enter_node(child++, level - 1, at);
    }
  }

  /// `blocks` reach into the node's voxels, the layer shared with the next node included.
  std::optional<Built> build_node(int level, const Index3& origin, const Blocks& blocks) {
    const std::int64_t size = BrickGrid::extent(level);
    const VoxelBox box{origin, {origin[0] + size, origin[1] + size, origin[2] + size}};
    if (blocks.empty()) return std::nullopt;
    const VoxelBlock& last = *blocks.back();
    if (last.leaf == VoxelBlock::kConstant && clipped(last).contains(box)) return constant_leaf(last, box);
    if (level == 0) return build_brick(box, blocks);

    const std::array<Blocks, 64> shares = distribute(level, origin, blocks);
    Children children;
    for (std::size_t i = 0; i < 64; ++i) {
      const auto slot = static_cast<std::int64_t>(i);
      const Index3 corner{origin[0] + (slot & 3) * size / 4, origin[1] + (slot >> 2 & 3) * size / 4,
                          origin[2] + (slot >> 4) * size / 4};
      children[i] = build_node(level - 1, corner, shares[i]);
    }
    if (is_one_value(children)) return children[0];
    return adopt(children);
  }

  std::array<Blocks, 64> distribute(int level, const Index3& origin, const Blocks& blocks) const {
    std::array<Blocks, 64> shares;
    const std::int64_t size = BrickGrid::extent(level - 1);
    for (const VoxelBlock* block : blocks) {
      const VoxelBox box = clipped(*block);
      Index3 from, to;
      for (std::size_t a = 0; a < 3; ++a) {
        // A voxel on the lower face of a child belongs to the child below as well.
        from[a] = std::clamp<std::int64_t>(std::max<std::int64_t>(box.lo[a] - 1 - origin[a], 0) / size, 0, 3);
        to[a] = std::clamp<std::int64_t>((box.hi[a] - origin[a]) / size, -1, 3);
      }
      for (std::int64_t z = from[2]; z <= to[2]; ++z)
        for (std::int64_t y = from[1]; y <= to[1]; ++y)
          for (std::int64_t x = from[0]; x <= to[0]; ++x) shares[static_cast<std::size_t>(x + 4 * y + 16 * z)].push_back(block);
    }
    return shares;
  }

  /// Then the first child can stand for all 64.
  bool is_one_value(const Children& children) const {
    const BrickStore& bricks = grid_.bricks_;
    for (const std::optional<Built>& child : children) {
      if (!child || !child->node.is_leaf() || !bricks.is_constant(child->node.first)) return false;
      for (int c = 0; c < bricks.channels(); ++c)
        if (bricks.constant(child->node.first, c) != bricks.constant(children[0]->node.first, c)) return false;
    }
    return true;
  }

  std::optional<Built> adopt(const Children& children) {
    const auto count = std::count_if(children.begin(), children.end(), [](const auto& child) { return child.has_value(); });
    take(static_cast<std::size_t>(count) * (sizeof(BrickGrid::Node) + channels_ * sizeof(ValueRange)));
    Built parent;
    parent.node.first = static_cast<std::uint32_t>(grid_.nodes_.size());
    std::array<double, kMaxChannels> mean{};
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
      grid_.ranges_.insert(grid_.ranges_.end(), children[i]->ranges.begin(), children[i]->ranges.begin() + grid_.channels());
    }
    if (parent.node.mask == 0) return std::nullopt;
    // Where a child is empty the ranges include 0 already: it shares voxels of 0 with a child that is not.
    for (std::size_t c = 0; c < channels_; ++c) parent.ranges[c].mean = static_cast<float>(mean[c] / 64);
    return parent;
  }

  // ----------------------------------------------------------------------------------------------- bricks

  std::optional<Built> constant_leaf(const VoxelBlock& block, const VoxelBox& box) {
    std::array<float, kMaxChannels> value{};
    for (std::size_t c = 0; c < channels_; ++c) value[c] = options_.rules.kept(block.value[c]);
    return add_constant(value, box);
  }

  std::optional<Built> add_constant(const std::array<float, kMaxChannels>& value, const VoxelBox& box) {
    if (std::all_of(value.begin(), value.end(), [](float v) { return v == 0; })) return std::nullopt;
    non_zero_.expand(box);
    take(channels_ * sizeof(BrickStore::Plane));
    Built built;
    built.node.first = grid_.bricks_.add_constant(value.data(), built.ranges);
    return built;
  }

  std::optional<Built> build_brick(const VoxelBox& box, const Blocks& blocks) {
    gather(box, blocks);
    bool constant = true;
    std::array<float, kMaxChannels> value{};
    for (std::size_t c = 0; c < channels_; ++c) {
      const float* first = voxels_.data() + c * kVoxels;
      value[c] = *first;
      constant = constant && std::all_of(first, first + kVoxels, [&](float v) { return v == *first; });
    }
    if (constant) return add_constant(value, box);
    if (!non_zero_.contains(box)) note_non_zero(box.lo);
    take(channels_ * (sizeof(BrickStore::Plane) + kVoxels * (options_.float_bricks ? sizeof(float) : sizeof(std::uint16_t)) +
                      8 * sizeof(ValueRange) + BlockMeans::kBytes));
    Built built;
    built.node.first = grid_.bricks_.add(voxels_.data(), built.ranges);
    grid_.block_means_.add(voxels_.data());
    grid_.octants_.add(voxels_.data());
    return built;
  }

  /// The 9^3 voxels of a brick from the blocks that reach into it.
  void gather(const VoxelBox& box, const Blocks& blocks) {
    std::fill(voxels_.begin(), voxels_.end(), 0.0f);
    for (const VoxelBlock* block : blocks) {
      const VoxelBox part = clipped(*block).intersect(box);
      if (part.empty()) continue;
      const Index3& lo = block->box.lo;
      const float* leaf = block->leaf == VoxelBlock::kConstant ? nullptr : leaves_.values(block->leaf);
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
              std::fill_n(out, run, options_.rules.kept(block->value[c]));
          }
    }
  }

  void note_non_zero(const Index3& origin) {
    std::size_t i = 0;
    for (std::size_t c = 0; c < channels_; ++c)
      for (std::int64_t z = 0; z < kSide; ++z)
        for (std::int64_t y = 0; y < kSide; ++y)
          for (std::int64_t x = 0; x < kSide; ++x) {
            if (voxels_[i++] == 0) continue;
            const Index3 at{origin[0] + x, origin[1] + y, origin[2] + z};
            non_zero_.expand({at, at});
          }
  }

  const VoxelSource& source_;
  BrickBuildOptions options_;
  std::size_t channels_;
  BrickGrid grid_;
  VoxelBox non_zero_;
  std::vector<float> voxels_;
  LeafCache leaves_;
  std::size_t taken_ = 0;  // bytes
};

BrickGrid build_brick_grid(const VoxelSource& source, const BrickBuildOptions& options) {
  return BrickGridBuilder(source, options).build();
}

}  // namespace tyndall
