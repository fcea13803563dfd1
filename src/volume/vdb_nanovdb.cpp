/// .nvdb files.
#include <algorithm>
#include <sstream>

#include "tyndall/error.h"
#include "volume/vdb_file.h"
#include "volume/vdb_nano_file.h"
#include "volume/vdb_nano_source.h"

namespace tyndall {
namespace {

/// Call body with a NanoSource of the grid's type; false for a type that holds no density.
template <typename Body>
bool with_source(const NanoBlob& blob, const Body& body) {
  using nanovdb::GridType;
  switch (blob.head().mGridType) {
    case GridType::Float:
      body(std::make_unique<NanoSource<float>>(blob));
      return true;
    case GridType::Double:
      body(std::make_unique<NanoSource<double>>(blob));
      return true;
    case GridType::Fp4:
      body(std::make_unique<NanoSource<nanovdb::Fp4>>(blob));
      return true;
    case GridType::Fp8:
      body(std::make_unique<NanoSource<nanovdb::Fp8>>(blob));
      return true;
    case GridType::Fp16:
      body(std::make_unique<NanoSource<nanovdb::Fp16>>(blob));
      return true;
    case GridType::FpN:
      body(std::make_unique<NanoSource<nanovdb::FpN>>(blob));
      return true;
    case GridType::Int32:
      body(std::make_unique<NanoSource<std::int32_t>>(blob));
      return true;
    case GridType::Vec3f:
      body(std::make_unique<NanoSource<nanovdb::Vec3f>>(blob));
      return true;
    case GridType::Vec3d:
      body(std::make_unique<NanoSource<nanovdb::Vec3d>>(blob));
      return true;
    default:
      return false;
  }
}

std::string type_name(nanovdb::GridType type) {
  return type < nanovdb::GridType::End ? nanovdb::toStr(type)
                                       : "unknown type " + std::to_string(static_cast<std::uint32_t>(type));
}

std::string number(float value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

const char* class_name(nanovdb::GridClass grid_class) {
  switch (grid_class) {
    case nanovdb::GridClass::LevelSet:
      return "level set";
    case nanovdb::GridClass::FogVolume:
      return "fog volume";
    case nanovdb::GridClass::Staggered:
      return "staggered vector field";
    case nanovdb::GridClass::Unknown:
      return "unknown";
    default:
      return "other";
  }
}

class NanoVdbFile : public VolumeFile {
 public:
  NanoVdbFile(const std::string& path, std::size_t most_memory) : path_(path), file_(read_nano_file(path, most_memory)) {
    for (const NanoBlob& blob : file_.grids) {
      VolumeGridEntry entry;
      entry.name = blob.name;
      entry.type = type_name(blob.head().mGridType);
      entry.grid_class = class_name(blob.head().mGridClass);
      entry.level_set = blob.head().mGridClass == nanovdb::GridClass::LevelSet;
      entry.leaves = reinterpret_cast<const nanovdb::TreeData<3>*>(&blob.head() + 1)->mNodeCount[0];
      switch (blob.head().mGridType) {
        case nanovdb::GridType::Vec3f:
        case nanovdb::GridType::Vec3d:
          entry.values = VolumeGridEntry::Values::vector;
          break;
        case nanovdb::GridType::Float:
        case nanovdb::GridType::Double:
        case nanovdb::GridType::Int32:
        case nanovdb::GridType::Fp4:
        case nanovdb::GridType::Fp8:
        case nanovdb::GridType::Fp16:
        case nanovdb::GridType::FpN:
          entry.values = VolumeGridEntry::Values::scalar;
          break;
        default:
          break;
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
      result.background = source->background().values();
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
    Rows rows{{"type", entries_[index].type},
              {"class", entries_[index].grid_class},
              {"compression", file_.grids[index].codec},
              {"voxel size", row(head.mVoxelSize)},
              {"world bounds", row(head.mWorldBBox.min()) + " .. " + row(head.mWorldBBox.max())}};
    with_checked_source(index, [&](const auto& source) {
      const VoxelBox box = source->active_box();
      rows.emplace_back("index bounds", row(box.lo) + " .. " + row(box.hi));
      rows.emplace_back("leaves", std::to_string(source->leaf_count()));
      rows.emplace_back("background", number(source->background().stored()[0]));
    });
    const auto& tree = *reinterpret_cast<const nanovdb::TreeData<3>*>(&head + 1);
    rows.emplace_back("active voxels", std::to_string(tree.mVoxelCount));
    rows.emplace_back("active tiles",
                      std::to_string(std::uint64_t{tree.mTileCount[0]} + tree.mTileCount[1] + tree.mTileCount[2]));
    add_range(index, rows);
    rows.emplace_back("memory", std::to_string(file_.grids[index].bytes.size()) + " bytes");
    return rows;
  }

 private:
  [[noreturn]] void fail(std::size_t index, const std::string& what) const {
    throw Error(Failure::scene, path_ + ": grid \"" + printable(entries_[index].name) + "\": " + what);
  }

  template <typename Body>
  void with_checked_source(std::size_t index, const Body& body) const {
    try {
      with_source(file_.grids[index], body);
    } catch (const DamagedGrid& damaged) {
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

std::unique_ptr<VolumeFile> open_nanovdb(const std::string& path, std::size_t most_memory) {
  return std::make_unique<NanoVdbFile>(path, most_memory);
}

}  // namespace tyndall
