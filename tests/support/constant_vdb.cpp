#include "support/constant_vdb.h"

#include <openvdb/openvdb.h>
#include <unistd.h>

#include <filesystem>

namespace tyndall::test {

ConstantVdb::ConstantVdb(const Bounds3& bounds, float voxel)
    : path_((std::filesystem::temp_directory_path() / ("constant_" + std::to_string(::getpid()) + ".vdb")).string()) {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  const auto index = [&](float v) { return static_cast<int>(std::lround(v / voxel)); };
  grid->fill({{index(bounds.min.x), index(bounds.min.y), index(bounds.min.z)},
              {index(bounds.max.x), index(bounds.max.y), index(bounds.max.z)}},
             1.0f);
  openvdb::io::File(path_).write({grid});
}

ConstantVdb::~ConstantVdb() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace tyndall::test
