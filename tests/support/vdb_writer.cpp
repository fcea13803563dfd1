#include "support/vdb_writer.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

namespace tyndall::test {
namespace {

openvdb::math::Transform::Ptr transform_of(const VdbGrid& grid) {
  if (grid.frustum)
    return openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), /*taper=*/0.5, /*depth=*/1.0);
  openvdb::Mat4R m;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m(j, i) = grid.index_to_world.matrix()[std::size_t(i)][std::size_t(j)];
  return openvdb::math::Transform::createLinearTransform(m);
}

template <typename GridT>
typename GridT::Ptr filled(const VdbGrid& spec) {
  using Value = typename GridT::ValueType;
  const auto value = [](float v) {
    if constexpr (openvdb::VecTraits<Value>::IsVec)
      return Value(v, v / 2, v / 4);
    else
      return static_cast<Value>(v);
  };
  auto grid = GridT::create(value(spec.background));
  for (const VdbGrid::Box& box : spec.boxes)
    grid->sparseFill({{box.lo[0], box.lo[1], box.lo[2]}, {box.hi[0], box.hi[1], box.hi[2]}}, value(box.value));
  auto accessor = grid->getAccessor();
  for (const VdbGrid::Voxel& voxel : spec.voxels)
    accessor.setValue({voxel.at[0], voxel.at[1], voxel.at[2]}, value(voxel.value));
  return grid;
}

openvdb::GridBase::Ptr grid_of(const VdbGrid& spec) {
  openvdb::GridBase::Ptr grid;
  switch (spec.type) {
    case VdbGrid::Type::scalar:
    case VdbGrid::Type::half:
      grid = filled<openvdb::FloatGrid>(spec);
      break;
    case VdbGrid::Type::double_precision:
      grid = filled<openvdb::DoubleGrid>(spec);
      break;
    case VdbGrid::Type::vec3:
      grid = filled<openvdb::Vec3SGrid>(spec);
      break;
  }
  grid->setName(spec.name);
  grid->setTransform(transform_of(spec));
  grid->setSaveFloatAsHalf(spec.type == VdbGrid::Type::half);
  if (spec.grid_class == VdbGrid::Class::fog) grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  if (spec.grid_class == VdbGrid::Class::level_set) grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

}  // namespace

void write_vdb(const std::string& path, const std::vector<VdbGrid>& grids) {
  openvdb::initialize();
  openvdb::GridPtrVec all;
  for (const VdbGrid& grid : grids) all.push_back(grid_of(grid));
  openvdb::io::File(path).write(all);
}

std::vector<float> openvdb_samples(const std::string& path, const std::vector<Vec3>& points) {
  openvdb::initialize();
  openvdb::io::File file(path);
  file.open(/*delayLoad=*/false);
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.getGrids()->front());
  const auto accessor = grid->getConstAccessor();
  std::vector<float> values;
  for (const Vec3& p : points) values.push_back(openvdb::tools::BoxSampler::sample(accessor, openvdb::Vec3R(p.x, p.y, p.z)));
  return values;
}

}  // namespace tyndall::test
