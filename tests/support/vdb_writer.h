/// .vdb files for tests, written by OpenVDB itself.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tyndall/math.h"

namespace tyndall::test {

/// One grid: boxes are filled first (active, as tiles where they can be), then single voxels are set.
struct VdbGrid {
  enum class Type { scalar, half, double_precision, vec3 } type = Type::scalar;
  enum class Class { fog, level_set, unknown } grid_class = Class::fog;
  struct Box {
    std::array<int, 3> lo, hi;  ///< both included
    float value;
  };
  struct Voxel {
    std::array<int, 3> at;
    float value;
  };
  std::string name = "density";
  Transform index_to_world{};
  bool frustum = false;
  float background = 0;
  std::vector<Box> boxes{};
  std::vector<Voxel> voxels{};
};

/// vec3 grids hold (v, v/2, v/4).
void write_vdb(const std::string& path, const std::vector<VdbGrid>& grids);

/// What OpenVDB's own trilinear BoxSampler reads from the first grid of a .vdb file, at index-space points.
std::vector<float> openvdb_samples(const std::string& path, const std::vector<Vec3>& points);

}  // namespace tyndall::test
