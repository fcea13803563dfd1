/// .vdb files through OpenVDB.
#include <fstream>
#include <mutex>
#include <sstream>

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Count.h>

#include "tyndall/error.h"
#include "volume/vdb_file.h"

namespace tyndall {
namespace {

VoxelBox box_of(const openvdb::CoordBBox& b) {
  return {{b.min().x(), b.min().y(), b.min().z()}, {b.max().x(), b.max().y(), b.max().z()}};
}

template <typename T>
std::array<float, 6> channels_of(const T& value) {
  if constexpr (openvdb::VecTraits<T>::IsVec)
    return {static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2])};
  else
    return {static_cast<float>(value)};
}

/// A grid's tree as blocks, values as stored whether active or not. With a background other than 0 the active bounding
/// box is filled with it first.
template <typename GridT>
class TreeSource : public VoxelSource {
 public:
  using ValueT = typename GridT::ValueType;

  explicit TreeSource(typename GridT::ConstPtr grid) : grid_(std::move(grid)), background_(channels_of(grid_->background())) {
    const auto& tree = grid_->constTree();
    openvdb::CoordBBox active;
    if (!tree.evalActiveVoxelBoundingBox(active)) return;  // nothing active: an empty grid
    if (tree.background() != openvdb::zeroVal<ValueT>()) clip_ = box_of(active);
    if (!background_.is_empty()) blocks_.push_back({*clip_, VoxelBlock::kConstant, background_.values()});
    auto tile = tree.cbeginValueAll();
    tile.setMaxDepth(tile.getLeafDepth() - 1);
    for (; tile; ++tile) {
      const auto value = channels_of(tile.getValue());
      if (!background_.is(value)) blocks_.push_back({box_of(tile.getBoundingBox()), VoxelBlock::kConstant, value});
    }
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
      blocks_.push_back({box_of(leaf->getNodeBoundingBox()), static_cast<std::uint32_t>(leaves_.size()), {}});
      leaves_.push_back(leaf.getLeaf());
    }
  }

  int channels() const override { return openvdb::VecTraits<ValueT>::IsVec ? 3 : 1; }
  const std::vector<VoxelBlock>& blocks() const override { return blocks_; }
  const std::optional<VoxelBox>& clip() const { return clip_; }
  const Background& background() const { return background_; }
  void read_leaf(std::uint32_t leaf, float* out) const override {
    const auto* data = leaves_[leaf]->buffer().data();
    for (openvdb::Index i = 0; i < kLeafVoxels; ++i) {
      const openvdb::Index x = i >> 6, y = i >> 3 & 7, z = i & 7;  // OpenVDB: z fastest
      const std::array<float, 6> value = background_.read(channels_of(data[i]));
      for (int c = 0; c < channels(); ++c)
        out[c * kLeafVoxels + static_cast<int>(z << 6 | y << 3 | x)] = value[static_cast<std::size_t>(c)];
    }
  }

 private:
  typename GridT::ConstPtr grid_;
  Background background_;
  std::vector<VoxelBlock> blocks_;
  std::vector<const typename GridT::TreeType::LeafNodeType*> leaves_;
  std::optional<VoxelBox> clip_;
};

using ScalarGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid>;
using VectorGrids = openvdb::TypeList<openvdb::Vec3SGrid, openvdb::Vec3DGrid>;
using ReadableGrids = ScalarGrids::Append<VectorGrids>;

Transform transform_of(const openvdb::GridBase& grid) {
  const openvdb::Mat4R m = grid.transform().baseMap()->getAffineMap()->getMat4();  // of row vectors
  Transform::Matrix t;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) t[i][j] = m(static_cast<int>(j), static_cast<int>(i));
  return Transform(t);
}

template <typename T>
std::string text(const T& value) {
  std::ostringstream out;
  out << value;
  return printable(out.str());
}

std::string box_text(const openvdb::BBoxd& box) {
  std::ostringstream out;
  out << box.min() << " .. " << box.max();
  return out.str();
}

class OpenVdbFile : public VolumeFile {
 public:
  explicit OpenVdbFile(const std::string& path) : path_(path) {
    static std::once_flag once;
    std::call_once(once, [] { openvdb::initialize(); });
    try {
      // A plain stream that throws: File and delayed loading lose errors or raise them in the middle of a tree.
      std::ifstream in;
      in.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
      in.open(path, std::ios::binary);
      openvdb::io::Stream stream(in, /*delayLoad=*/false);
      version_ = stream.version();
      file_version_ = stream.fileVersion();
      metadata_ = stream.getMetadata();
      for (const openvdb::GridBase::Ptr& grid : *stream.getGrids())
        if (grid) grids_.push_back(grid);
    } catch (const std::ios::failure&) {
      throw Error(Failure::scene, path + ": ends too early or cannot be read; it may have been cut off while it was written");
    } catch (const std::bad_alloc&) {
      throw Error(Failure::scene, path + ": needs more memory than there is; it may be damaged");
    } catch (const std::exception& e) {
      throw Error(Failure::scene, path + ": cannot be read as OpenVDB: " + printable(e.what()));
    }
    for (const openvdb::GridBase::Ptr& grid : grids_) entries_.push_back(entry_of(*grid));
  }

  std::string format() const override { return "OpenVDB"; }
  const std::vector<VolumeGridEntry>& grids() const override { return entries_; }

  Rows properties() const override {
    Rows rows{{"file version", std::to_string(file_version_)},
              {"written by library", version_},
              {"grids", std::to_string(grids_.size())}};
    if (metadata_) add_metadata(*metadata_, rows);
    return rows;
  }

  VolumeGrid load(std::size_t index) const override {
    VolumeGrid result;
    const openvdb::GridBase& base = *grids_[index];
    try {
      result.index_to_world = transform_of(base);
    } catch (const Error& e) {
      throw Error(Failure::scene, path_ + ": grid \"" + printable(entries_[index].name) + "\": " + e.what());
    }
    grids_[index]->apply<ReadableGrids>([&](const auto& typed) {
      using GridT = std::decay_t<decltype(typed)>;
      auto source = std::make_unique<TreeSource<GridT>>(openvdb::gridConstPtrCast<GridT>(grids_[index]));
      result.clip = source->clip();
      result.background = source->background().values();
      result.source = std::move(source);
    });
    if (!result.source)
      throw Error(Failure::scene, path_ + ": grid \"" + printable(entries_[index].name) + "\" of type " + entries_[index].type +
                                      " cannot be used");
    return result;
  }

  Rows describe(std::size_t index) const override {
    const openvdb::GridBase& grid = *grids_[index];
    Rows rows{{"type", entries_[index].type + (grid.saveFloatAsHalf() ? " (stored as half)" : "")},
              {"class", entries_[index].grid_class},
              {"voxel size", text(grid.voxelSize())},
              {"transform", printable(grid.transform().mapType())}};
    if (entries_[index].linear)
      rows.emplace_back("index to world", text(grid.transform().baseMap()->getAffineMap()->getMat4()));
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (grid.activeVoxelCount() > 0) {
      rows.emplace_back("index bounds", text(box.min()) + " .. " + text(box.max()));
      rows.emplace_back(
          "world bounds",
          box_text(grid.transform().indexToWorld(openvdb::BBoxd(box.min().asVec3d() - 0.5, box.max().asVec3d() + 0.5))));
    } else {
      rows.emplace_back("world bounds", "empty");
    }
    rows.emplace_back("active voxels", std::to_string(grid.activeVoxelCount()));
    rows.emplace_back("active tiles", std::to_string(grid.constBaseTree().activeTileCount()));
    rows.emplace_back("leaves", std::to_string(grid.constBaseTree().leafCount()));
    grids_[index]->apply<ReadableGrids>([&](const auto& typed) {
      rows.emplace_back("background", text(typed.background()));
      const auto range = openvdb::tools::minMax(typed.constTree(), /*threaded=*/false);
      rows.emplace_back("minimum", text(range.min()));
      rows.emplace_back("maximum", text(range.max()));
    });
    rows.emplace_back("memory", std::to_string(grid.memUsage()) + " bytes");
    add_metadata(grid, rows);
    return rows;
  }

 private:
  static VolumeGridEntry entry_of(const openvdb::GridBase& grid) {
    VolumeGridEntry entry;
    entry.name = grid.getName();
    entry.type = grid.isType<openvdb::FloatGrid>() || !is_point_grid(grid) ? printable(grid.valueType()) : "PointDataGrid";
    entry.grid_class = openvdb::GridBase::gridClassToMenuName(grid.getGridClass());
    entry.level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
    entry.linear = grid.transform().isLinear();
    entry.leaves = grid.constBaseTree().leafCount();
    if (grid.apply<ScalarGrids>([](const auto&) {})) entry.values = VolumeGridEntry::Values::scalar;
    if (grid.apply<VectorGrids>([](const auto&) {})) entry.values = VolumeGridEntry::Values::vector;
    return entry;
  }
  static bool is_point_grid(const openvdb::GridBase& grid) { return grid.valueType().find("ptdata") != std::string::npos; }

  static void add_metadata(const openvdb::MetaMap& map, Rows& rows) {
    for (auto it = map.beginMeta(); it != map.endMeta(); ++it)
      rows.emplace_back("metadata " + printable(it->first), printable(it->second->str()));
  }

  std::string path_, version_;
  std::uint32_t file_version_ = 0;
  openvdb::MetaMap::Ptr metadata_;
  std::vector<openvdb::GridBase::Ptr> grids_;
  std::vector<VolumeGridEntry> entries_;
};

}  // namespace

std::unique_ptr<VolumeFile> open_openvdb(const std::string& path) { return std::make_unique<OpenVdbFile>(path); }

}  // namespace tyndall
