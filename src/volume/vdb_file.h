/// The only interface to OpenVDB and NanoVDB: volume files as plain grids of ours.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tyndall/math.h"
#include "volume/voxel_source.h"

namespace tyndall {

/// What is known of a grid before its voxels are looked at.
struct VolumeGridEntry {
  enum class Values { scalar, vector, other } values = Values::other;
  std::string name;        ///< as the file has it, which need not be printable
  std::string type;        ///< "float", "vec3s", "PointDataGrid" ...
  std::string grid_class;  ///< "fog volume", "level set", "unknown" ...
  bool level_set = false;
  bool linear = true;                      ///< its map is affine
  std::uint64_t leaves = 0;                ///< of 8^3 voxels
  std::size_t read_bytes = sizeof(float);  ///< that each number of a voxel takes while the grid is loaded, about
};

/// A grid's voxels and where they lie. Must not outlive its file.
struct VolumeGrid {
  std::unique_ptr<VoxelSource> source;
  Transform index_to_world;
  std::optional<VoxelBox> clip;  ///< set when the background is not 0: the active bounding box
  Background::Values background{};
};

/// An open .vdb or .nvdb file, wholly in memory.
class VolumeFile {
 public:
  using Rows = std::vector<std::pair<std::string, std::string>>;

  virtual ~VolumeFile() = default;
  virtual std::string format() const = 0;  ///< "OpenVDB 224" ...
  virtual Rows properties() const = 0;     ///< of the file
  virtual const std::vector<VolumeGridEntry>& grids() const = 0;
  virtual VolumeGrid load(std::size_t grid) const = 0;  ///< a scalar or vector grid with a linear map
  virtual Rows describe(std::size_t grid) const = 0;
};

/// By content: OpenVDB's or NanoVDB's magic number. Reading takes no more than `most_memory` bytes. OpenVDB's library,
/// which some damaged files crash, works in a process of its own. Throws Error (scene) naming the file and what is wrong
/// with it.
std::unique_ptr<VolumeFile> open_volume(const std::string& path,
                                        std::size_t most_memory = std::numeric_limits<std::size_t>::max());

// The two kinds, read in this process; open_volume chooses.
std::unique_ptr<VolumeFile> open_openvdb(const std::string& path);
std::unique_ptr<VolumeFile> open_nanovdb(const std::string& path, std::size_t most_memory);

/// Text that a file or a library supplies, fit for a message: printable, one line, at most 300 characters.
std::string printable(const std::string& text);

}  // namespace tyndall
