/// .nvdb files. Nothing in them is trusted: every offset is held against the size of the buffer before it is followed.
#include <sstream>

#include <nanovdb/util/GridChecksum.h>

#include "tyndall/error.h"
#include "volume/vdb_file.h"
#include "volume/vdb_nano_file.h"

namespace tyndall {
namespace {

struct Damaged {
  const char* what;
};

/// A pointer `bytes` away from `from`, if a whole T lies there inside the buffer.
template <typename T>
const T* checked(const NanoBlob& blob, const void* from, std::int64_t bytes) {
  const auto begin = reinterpret_cast<std::intptr_t>(blob.bytes.data());
  const std::intptr_t end = begin + static_cast<std::intptr_t>(blob.bytes.size());
  const std::intptr_t origin = reinterpret_cast<std::intptr_t>(from);
  // Compared before they are added: the sum could wrap.
  if (bytes < begin - origin || bytes > end - origin - static_cast<std::intptr_t>(sizeof(T))) throw Damaged{"a node lies outside the file"};
  const std::intptr_t at = origin + bytes;
  if ((at - begin) % 32 != 0) throw Damaged{"a node is misaligned"};
  return reinterpret_cast<const T*>(at);
}

template <typename T>
std::array<float, 6> channels_of(const T& value) {
  if constexpr (nanovdb::is_same<T, nanovdb::Vec3f>::value || nanovdb::is_same<T, nanovdb::Vec3d>::value)
    return {static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2])};
  else
    return {static_cast<float>(value)};
}

template <typename BuildT>
class NanoSource : public VoxelSource {
 public:
  using Root = typename nanovdb::NanoGrid<BuildT>::RootType;
  using Upper = typename Root::ChildNodeType;
  using Lower = typename Upper::ChildNodeType;
  using Leaf = typename Lower::ChildNodeType;
  using ValueT = typename Root::ValueType;
  static constexpr bool kVector = nanovdb::is_same<ValueT, nanovdb::Vec3f>::value || nanovdb::is_same<ValueT, nanovdb::Vec3d>::value;

  explicit NanoSource(const NanoBlob& blob) : blob_(&blob) {
    const auto* tree = checked<nanovdb::TreeData<3>>(blob, &blob.head() + 1, 0);
    if (tree->mNodeOffset[3] > blob.bytes.size()) throw Damaged{"a node lies outside the file"};
    root_ = checked<typename Root::DataType>(blob, tree, static_cast<std::int64_t>(tree->mNodeOffset[3]));
    if (root_->mTableSize > blob.bytes.size() / sizeof(typename Root::DataType::Tile)) throw Damaged{"the root is too large"};
    fill_background();
    for (std::uint32_t i = 0; i < root_->mTableSize; ++i) {
      const auto* tile = checked<typename Root::DataType::Tile>(
          blob, root_ + 1, static_cast<std::int64_t>(i) * static_cast<std::int64_t>(sizeof(typename Root::DataType::Tile)));
      const auto key = tile->origin();
      const Index3 origin{key[0], key[1], key[2]};
      if (tile->isChild()) {
        ++upper_count_;
        visit<typename Upper::DataType>(*checked<typename Upper::DataType>(blob, root_, tile->child), origin);
      } else {
        add_tile(tile->value, origin, 4096);
      }
    }
    check_counts(*tree);
  }

  int channels() const override { return kVector ? 3 : 1; }
  const std::vector<VoxelBlock>& blocks() const override { return blocks_; }
  const std::optional<VoxelBox>& clip() const { return clip_; }
  void read_leaf(std::uint32_t leaf, float* out) const override {
    for (std::uint32_t i = 0; i < kLeafVoxels; ++i) {
      const std::uint32_t x = i >> 6, y = i >> 3 & 7, z = i & 7;  // NanoVDB: z fastest
      const std::array<float, 6> value = channels_of(leaves_[leaf]->getValue(i));
      for (int c = 0; c < channels(); ++c) out[c * kLeafVoxels + static_cast<int>(z << 6 | y << 3 | x)] = value[static_cast<std::size_t>(c)];
    }
  }

  /// After the constructor, which has made the tree safe to walk.
  bool checksum_holds() const {
    return nanovdb::validateChecksum(*reinterpret_cast<const nanovdb::NanoGrid<BuildT>*>(blob_->bytes.data()), nanovdb::ChecksumMode::Full);
  }
  std::array<float, 6> background() const { return channels_of(root_->mBackground); }
  VoxelBox active_box() const {
    const auto& b = root_->mBBox;
    return {{b.min()[0], b.min()[1], b.min()[2]}, {b.max()[0], b.max()[1], b.max()[2]}};
  }
  std::size_t leaf_count() const { return leaves_.size(); }

 private:
  /// The checksum goes through the nodes by these numbers.
  void check_counts(const nanovdb::TreeData<3>& tree) const {
    if (tree.mNodeCount[0] != leaves_.size() || tree.mNodeCount[1] != lower_count_ || tree.mNodeCount[2] != upper_count_)
      throw Damaged{"its number of nodes differs from its header"};
    if (leaves_.empty() && lower_count_ == 0 && upper_count_ == 0) return;
    const std::uint64_t sizes[3] = {Leaf::DataType::FIXED_SIZE ? sizeof(typename Leaf::DataType) : 0, sizeof(typename Lower::DataType),
                                    sizeof(typename Upper::DataType)};
    const auto at = static_cast<std::uint64_t>(reinterpret_cast<const std::uint8_t*>(&tree) - blob_->bytes.data());
    for (int level = 0; level < 3; ++level) {
      const std::uint64_t room = blob_->bytes.size() - at;
      if (tree.mNodeCount[level] == 0) continue;
      if (tree.mNodeOffset[level] > room || tree.mNodeOffset[level] % 32 != 0 || sizes[level] * tree.mNodeCount[level] > room - tree.mNodeOffset[level])
        throw Damaged{"a node lies outside the file"};
    }
  }

  void fill_background() {
    if (root_->mBackground == ValueT(0)) return;
    clip_ = active_box();
    if (!clip_->empty()) blocks_.push_back({*clip_, VoxelBlock::kConstant, background()});
  }
  void add_tile(const ValueT& value, const Index3& origin, std::int64_t size) {
    if (value == root_->mBackground) return;
    blocks_.push_back({{origin, {origin[0] + size - 1, origin[1] + size - 1, origin[2] + size - 1}}, VoxelBlock::kConstant, channels_of(value)});
  }

  /// Children and tiles of an internal node at `origin`; positions follow from the slots, not from the node's own box.
  template <typename Data>
  void visit(const Data& node, const Index3& origin) {
    constexpr bool kUpper = std::is_same_v<Data, typename Upper::DataType>;
    constexpr std::uint32_t kLog2 = kUpper ? 5 : 4;
    constexpr std::int64_t kSize = kUpper ? 128 : 8;
    for (std::uint32_t n = 0; n < std::uint32_t{1} << (3 * kLog2); ++n) {
      constexpr std::uint32_t kMask = (1u << kLog2) - 1;
      const Index3 at{origin[0] + (n >> (2 * kLog2)) * kSize, origin[1] + (n >> kLog2 & kMask) * kSize, origin[2] + (n & kMask) * kSize};
      if (!node.mChildMask.isOn(n)) {
        add_tile(node.mTable[n].value, at, kSize);
      } else if constexpr (kUpper) {
        ++lower_count_;
        visit<typename Lower::DataType>(*checked<typename Lower::DataType>(*blob_, &node, node.mTable[n].child), at);
      } else {
        add_leaf(*checked<typename Leaf::DataType>(*blob_, &node, node.mTable[n].child), at);
      }
    }
  }
  void add_leaf(const typename Leaf::DataType& leaf, const Index3& origin) {
    if (leaves_.size() >= blob_->bytes.size() / 64) throw Damaged{"there are more leaves than fit into the file"};
    // Leaves of FpN differ in size; the last byte must lie in the buffer as well.
    const std::uint64_t size = leaf.memUsage();
    const auto* last = reinterpret_cast<const std::uint8_t*>(&leaf) + size;
    if (last > blob_->bytes.data() + blob_->bytes.size()) throw Damaged{"a leaf lies outside the file"};
    blocks_.push_back({{origin, {origin[0] + 7, origin[1] + 7, origin[2] + 7}}, static_cast<std::uint32_t>(leaves_.size()), {}});
    leaves_.push_back(&leaf);
  }

  const NanoBlob* blob_;
  const typename Root::DataType* root_ = nullptr;
  std::vector<VoxelBlock> blocks_;
  std::vector<const typename Leaf::DataType*> leaves_;
  std::optional<VoxelBox> clip_;
  std::uint32_t lower_count_ = 0, upper_count_ = 0;
};

/// Call body with a NanoSource of the grid's type; false for a type that holds no density.
template <typename Body>
bool with_source(const NanoBlob& blob, const Body& body) {
  using nanovdb::GridType;
  switch (blob.head().mGridType) {
    case GridType::Float: body(std::make_unique<NanoSource<float>>(blob)); return true;
    case GridType::Double: body(std::make_unique<NanoSource<double>>(blob)); return true;
    case GridType::Fp4: body(std::make_unique<NanoSource<nanovdb::Fp4>>(blob)); return true;
    case GridType::Fp8: body(std::make_unique<NanoSource<nanovdb::Fp8>>(blob)); return true;
    case GridType::Fp16: body(std::make_unique<NanoSource<nanovdb::Fp16>>(blob)); return true;
    case GridType::FpN: body(std::make_unique<NanoSource<nanovdb::FpN>>(blob)); return true;
    case GridType::Int32: body(std::make_unique<NanoSource<std::int32_t>>(blob)); return true;
    case GridType::Vec3f: body(std::make_unique<NanoSource<nanovdb::Vec3f>>(blob)); return true;
    case GridType::Vec3d: body(std::make_unique<NanoSource<nanovdb::Vec3d>>(blob)); return true;
    default: return false;
  }
}

std::string type_name(nanovdb::GridType type) {
  return type < nanovdb::GridType::End ? nanovdb::toStr(type) : "unknown type " + std::to_string(static_cast<std::uint32_t>(type));
}

std::string number(float value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

const char* class_name(nanovdb::GridClass grid_class) {
  switch (grid_class) {
    case nanovdb::GridClass::LevelSet: return "level set";
    case nanovdb::GridClass::FogVolume: return "fog volume";
    case nanovdb::GridClass::Staggered: return "staggered vector field";
    case nanovdb::GridClass::Unknown: return "unknown";
    default: return "other";
  }
}

class NanoVdbFile : public VolumeFile {
 public:
  explicit NanoVdbFile(const std::string& path) : path_(path), file_(read_nano_file(path)) {
    for (const NanoBlob& blob : file_.grids) {
      VolumeGridEntry entry;
      entry.name = printable(blob.head().mGridName);
      entry.type = type_name(blob.head().mGridType);
      entry.grid_class = class_name(blob.head().mGridClass);
      entry.level_set = blob.head().mGridClass == nanovdb::GridClass::LevelSet;
      switch (blob.head().mGridType) {
        case nanovdb::GridType::Vec3f:
        case nanovdb::GridType::Vec3d: entry.values = VolumeGridEntry::Values::vector; break;
        case nanovdb::GridType::Float:
        case nanovdb::GridType::Double:
        case nanovdb::GridType::Int32:
        case nanovdb::GridType::Fp4:
        case nanovdb::GridType::Fp8:
        case nanovdb::GridType::Fp16:
        case nanovdb::GridType::FpN: entry.values = VolumeGridEntry::Values::scalar; break;
        default: break;
      }
      entries_.push_back(entry);
    }
  }

  std::string format() const override { return "NanoVDB"; }
  Rows properties() const override { return {{"file version", file_.version}, {"grids", std::to_string(file_.grids.size())}}; }
  const std::vector<VolumeGridEntry>& grids() const override { return entries_; }

  VolumeGrid load(std::size_t index) const override {
    VolumeGrid result;
    with_checked_source(index, [&](auto source) {
      result.clip = source->clip();
      result.source = std::move(source);
    });
    if (!result.source) fail(index, "is of type " + entries_[index].type + ", which cannot be used");
    Transform::Matrix m{};
    const nanovdb::Map& map = file_.grids[index].head().mMap;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) m[i][j] = map.mMatD[3 * i + j];
      m[i][3] = map.mVecD[i];
    }
    m[3][3] = 1;
    try {
      result.index_to_world = Transform(m);
    } catch (const Error& e) {
      fail(index, e.what());
    }
    return result;
  }

  Rows describe(std::size_t index) const override {
    const nanovdb::GridData& head = file_.grids[index].head();
    const auto row = [](const auto& v) {
      std::ostringstream out;
      out << "[" << v[0] << ", " << v[1] << ", " << v[2] << "]";
      return out.str();
    };
    Rows rows{{"type", entries_[index].type}, {"class", entries_[index].grid_class}, {"compression", file_.grids[index].codec},
              {"voxel size", row(head.mVoxelSize)}, {"world bounds", row(head.mWorldBBox.min()) + " .. " + row(head.mWorldBBox.max())}};
    with_checked_source(index, [&](const auto& source) {
      const VoxelBox box = source->active_box();
      rows.emplace_back("index bounds", row(box.lo) + " .. " + row(box.hi));
      rows.emplace_back("leaves", std::to_string(source->leaf_count()));
      rows.emplace_back("background", number(source->background()[0]));
    });
    const auto& tree = *reinterpret_cast<const nanovdb::TreeData<3>*>(&head + 1);
    rows.emplace_back("active voxels", std::to_string(tree.mVoxelCount));
    rows.emplace_back("active tiles", std::to_string(std::uint64_t{tree.mTileCount[0]} + tree.mTileCount[1] + tree.mTileCount[2]));
    add_range(index, rows);
    rows.emplace_back("memory", std::to_string(file_.grids[index].bytes.size()) + " bytes");
    return rows;
  }

 private:
  [[noreturn]] void fail(std::size_t index, const std::string& what) const {
    throw Error(Failure::scene, path_ + ": grid \"" + entries_[index].name + "\": " + what);
  }

  template <typename Body>
  void with_checked_source(std::size_t index, const Body& body) const {
    try {
      with_source(file_.grids[index], [&](auto source) {
        if (!source->checksum_holds()) throw Damaged{"its checksum does not fit its content"};
        body(std::move(source));
      });
    } catch (const Damaged& damaged) {
      fail(index, std::string(damaged.what) + "; the file is damaged");
    }
  }

  /// Over all voxels that are stored, active or not.
  void add_range(std::size_t index, Rows& rows) const {
    with_checked_source(index, [&](const auto& source) {
      float low = kInfinity, high = -kInfinity;
      std::vector<float> values(VoxelSource::kLeafVoxels * static_cast<std::size_t>(source->channels()));
      for (const VoxelBlock& block : source->blocks()) {
        if (block.leaf == VoxelBlock::kConstant)
          std::fill(values.begin(), values.end(), block.value[0]);
        else
          source->read_leaf(block.leaf, values.data());
        low = std::min(low, *std::min_element(values.begin(), values.end()));
        high = std::max(high, *std::max_element(values.begin(), values.end()));
      }
      if (low > high) return;
      rows.emplace_back("minimum", number(low));
      rows.emplace_back("maximum", number(high));
    });
  }

  std::string path_;
  NanoFile file_;
  std::vector<VolumeGridEntry> entries_;
};

}  // namespace

std::unique_ptr<VolumeFile> open_nanovdb(const std::string& path) { return std::make_unique<NanoVdbFile>(path); }

}  // namespace tyndall
