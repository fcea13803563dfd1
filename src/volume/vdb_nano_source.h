/// The tree of a NanoVDB grid as blocks of voxels. Nothing in it is trusted: every offset is held against the size of
/// the buffer before it is followed.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include <nanovdb/util/GridChecksum.h>

#include "volume/vdb_nano_file.h"
#include "volume/voxel_source.h"

namespace tyndall {

/// Thrown by NanoSource for a grid that contradicts itself.
struct DamagedGrid {
  const char* what;
};

template <typename BuildT>
class NanoSource : public VoxelSource {
 public:
  using Root = typename nanovdb::NanoGrid<BuildT>::RootType;
  using Upper = typename Root::ChildNodeType;
  using Lower = typename Upper::ChildNodeType;
  using Leaf = typename Lower::ChildNodeType;
  using Tile = typename Root::DataType::Tile;
  using ValueT = typename Root::ValueType;
  static constexpr bool kVector = std::is_same_v<ValueT, nanovdb::Vec3f> || std::is_same_v<ValueT, nanovdb::Vec3d>;

  /// Throws DamagedGrid. The blob must outlive the source.
  explicit NanoSource(const NanoBlob& blob) : blob_(&blob) {
    const auto* tree = checked<nanovdb::TreeData<3>>(&blob.head() + 1, 0);
    if (tree->mNodeOffset[3] > blob.bytes.size()) throw DamagedGrid{"a node lies outside the file"};
    root_ = checked<typename Root::DataType>(tree, static_cast<std::int64_t>(tree->mNodeOffset[3]));
    if (root_->mTableSize > blob.bytes.size() / sizeof(Tile)) throw DamagedGrid{"its root is too large"};
    fill_background();
    for (std::uint32_t i = 0; i < root_->mTableSize; ++i)
      visit_root(*checked<Tile>(root_ + 1, std::int64_t{i} * static_cast<std::int64_t>(sizeof(Tile))));
    check_counts(*tree);
    const auto* grid = reinterpret_cast<const nanovdb::NanoGrid<BuildT>*>(blob.bytes.data());
    if (!nanovdb::validateChecksum(*grid, nanovdb::ChecksumMode::Full))
      throw DamagedGrid{"its checksum does not fit its content"};
  }

  int channels() const override { return kVector ? 3 : 1; }
  const std::vector<VoxelBlock>& blocks() const override { return blocks_; }
  const std::optional<VoxelBox>& clip() const { return clip_; }
  void read_leaf(std::uint32_t leaf, float* out) const override {
    for (std::uint32_t i = 0; i < kLeafVoxels; ++i) {
      const std::uint32_t x = i >> 6, y = i >> 3 & 7, z = i & 7;  // NanoVDB: z fastest
      const std::array<float, 6> value = background_.read(channels_of(leaves_[leaf]->getValue(i)));
      for (int c = 0; c < channels(); ++c)
        out[c * kLeafVoxels + static_cast<int>(z << 6 | y << 3 | x)] = value[static_cast<std::size_t>(c)];
    }
  }

  const Background& background() const { return background_; }
  VoxelBox active_box() const {
    const auto& b = root_->mBBox;
    return {{b.min()[0], b.min()[1], b.min()[2]}, {b.max()[0], b.max()[1], b.max()[2]}};
  }
  std::size_t leaf_count() const { return leaves_.size(); }

 private:
  static std::array<float, 6> channels_of(const ValueT& value) {
    if constexpr (kVector)
      return {static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2])};
    else
      return {static_cast<float>(value)};
  }

  /// A pointer `bytes` away from `from`, if a whole T lies there inside the buffer.
  template <typename T>
  const T* checked(const void* from, std::int64_t bytes) const {
    const auto begin = reinterpret_cast<std::intptr_t>(blob_->bytes.data());
    const std::intptr_t end = begin + static_cast<std::intptr_t>(blob_->bytes.size());
    const auto origin = reinterpret_cast<std::intptr_t>(from);
    // Compared before they are added: the sum could wrap.
    if (bytes < begin - origin || bytes > end - origin - static_cast<std::intptr_t>(sizeof(T)))
      throw DamagedGrid{"a node lies outside the file"};
    const std::intptr_t at = origin + bytes;
    if ((at - begin) % 32 != 0) throw DamagedGrid{"a node is misaligned"};
    return reinterpret_cast<const T*>(at);
  }

  void fill_background() {
    background_ = Background(channels_of(root_->mBackground));
    if (root_->mBackground == ValueT(0)) return;
    clip_ = active_box();
    if (!clip_->empty() && !background_.is_empty()) blocks_.push_back({*clip_, VoxelBlock::kConstant, background_.values()});
  }

  void visit_root(const Tile& tile) {
    const auto key = tile.origin();
    const Index3 origin{key[0], key[1], key[2]};
    if (!tile.isChild()) return add_tile(tile.value, origin, 4096);
    ++upper_count_;
    visit(*checked<typename Upper::DataType>(root_, tile.child), origin);
  }

  /// Children and tiles of an internal node at `origin`; positions follow from the slots, not from the node's own box.
  template <typename Data>
  void visit(const Data& node, const Index3& origin) {
    constexpr bool kUpper = std::is_same_v<Data, typename Upper::DataType>;
    constexpr std::uint32_t kLog2 = kUpper ? 5 : 4, kMask = (1u << kLog2) - 1;
    constexpr std::int64_t kSize = kUpper ? 128 : 8;
    for (std::uint32_t n = 0; n < std::uint32_t{1} << (3 * kLog2); ++n) {
      const Index3 at{origin[0] + (n >> (2 * kLog2)) * kSize, origin[1] + (n >> kLog2 & kMask) * kSize,
                      origin[2] + (n & kMask) * kSize};
      if (!node.mChildMask.isOn(n)) {
        add_tile(node.mTable[n].value, at, kSize);
      } else if constexpr (kUpper) {
        ++lower_count_;
        visit(*checked<typename Lower::DataType>(&node, node.mTable[n].child), at);
      } else {
        add_leaf(*checked<typename Leaf::DataType>(&node, node.mTable[n].child), at);
      }
    }
  }

  void add_tile(const ValueT& value, const Index3& origin, std::int64_t size) {
    if (background_.is(channels_of(value))) return;
    const Index3 last{origin[0] + size - 1, origin[1] + size - 1, origin[2] + size - 1};
    blocks_.push_back({{origin, last}, VoxelBlock::kConstant, channels_of(value)});
  }

  void add_leaf(const typename Leaf::DataType& leaf, const Index3& origin) {
    if (leaves_.size() >= blob_->bytes.size() / 64) throw DamagedGrid{"there are more leaves than fit into the file"};
    // Leaves of FpN differ in size; the last byte must lie in the buffer as well.
    const auto from = static_cast<std::uint64_t>(reinterpret_cast<const std::uint8_t*>(&leaf) - blob_->bytes.data());
    if (static_cast<std::uint64_t>(leaf.memUsage()) > blob_->bytes.size() - from)
      throw DamagedGrid{"a leaf lies outside the file"};
    blocks_.push_back(
        {{origin, {origin[0] + 7, origin[1] + 7, origin[2] + 7}}, static_cast<std::uint32_t>(leaves_.size()), {}});
    leaves_.push_back(&leaf);
  }

  /// The checksum goes through the nodes by these numbers.
  void check_counts(const nanovdb::TreeData<3>& tree) const {
    if (tree.mNodeCount[0] != leaves_.size() || tree.mNodeCount[1] != lower_count_ || tree.mNodeCount[2] != upper_count_)
      throw DamagedGrid{"its number of nodes differs from its header"};
    const std::uint64_t sizes[3] = {Leaf::DataType::FIXED_SIZE ? sizeof(typename Leaf::DataType) : 0,
                                    sizeof(typename Lower::DataType), sizeof(typename Upper::DataType)};
    const auto at = static_cast<std::uint64_t>(reinterpret_cast<const std::uint8_t*>(&tree) - blob_->bytes.data());
    const std::uint64_t room = blob_->bytes.size() - at;
    for (int level = 0; level < 3; ++level) {
      if (tree.mNodeCount[level] == 0) continue;
      const std::uint64_t offset = tree.mNodeOffset[level];
      if (offset > room || offset % 32 != 0 || sizes[level] * tree.mNodeCount[level] > room - offset)
        throw DamagedGrid{"a node lies outside the file"};
    }
  }

  const NanoBlob* blob_;
  const typename Root::DataType* root_ = nullptr;
  Background background_{{}};
  std::vector<VoxelBlock> blocks_;
  std::vector<const typename Leaf::DataType*> leaves_;
  std::optional<VoxelBox> clip_;
  std::uint32_t lower_count_ = 0, upper_count_ = 0;
};

}  // namespace tyndall
