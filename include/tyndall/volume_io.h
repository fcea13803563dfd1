/// What a volume file holds, and making one.
#pragma once

#include <string>
#include <vector>

#include "tyndall/io.h"
#include "tyndall/math.h"

namespace tyndall {

/// Every grid of a .vdb or .nvdb file: name, type, class, voxel size, transform, bounds in world and index space,
/// active voxels and tiles, background, smallest and largest value, memory, metadata. Recognised by content, not by
/// name. Throws Error (scene) when the file cannot be read.
Description describe_volume(const std::string& path);

/// A dense grid of a fog volume: nx * ny * nz values, x fastest.
struct FogGrid {
  std::string name = "density";
  int nx = 0, ny = 0, nz = 0;
  std::vector<float> values{};  ///< >= 0; voxels of 0 are not stored
  float voxel_size = 1;         ///< scene units
  Vec3 origin{};                ///< centre of the first voxel
};

/// The bytes of an OpenVDB file (float grids, ZIP) that holds the grids. Equal grids give equal bytes. What is returned
/// has been read back and compared voxel by voxel. Throws Error (output) for sizes that do not agree, a value that is
/// negative or not finite, and when the read-back differs.
std::string encode_vdb_fog(const std::vector<FogGrid>& grids);

}  // namespace tyndall
