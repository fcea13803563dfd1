#include <doctest/doctest.h>

#include <limits>

#include "support/scratch.h"
#include "support/vdb_writer.h"
#include "tyndall/volume_io.h"
#include "volume/vdb_file.h"

namespace tyndall {
namespace {

/// 9 x 5 x 12 voxels, a third of them empty.
FogGrid sample() {
  FogGrid grid;
  grid.nx = 9, grid.ny = 5, grid.nz = 12;
  grid.voxel_size = 0.25f;
  grid.origin = {1, -2, 3};
  for (int i = 0; i < 9 * 5 * 12; ++i) grid.values.push_back(i % 3 ? 0.01f * static_cast<float>(i) : 0);
  return grid;
}

/// A file that lasts as long as this.
struct Saved {
  test::Scratch folder;
  std::string path = folder / "fog.vdb";

  explicit Saved(const std::string& bytes) { test::write_bytes(path, bytes); }
};

TEST_CASE("every voxel of a written fog reads back, where it was") {
  const FogGrid fog = sample();
  const Saved saved(encode_vdb_fog({fog}));
  const std::string& path = saved.path;
  std::vector<Vec3> points;
  for (int z = 0; z < 12; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 9; ++x) points.push_back({float(x), float(y), float(z)});
  CHECK(test::openvdb_samples(path, points) == fog.values);

  const auto file = open_volume(path);
  REQUIRE(file->grids().size() == 1);
  CHECK(file->grids()[0].name == "density");
  CHECK(file->grids()[0].grid_class == "Fog Volume");
  CHECK(file->load(0).index_to_world.point({0, 0, 0}) == Vec3{1, -2, 3});
  CHECK(file->load(0).index_to_world.point({4, 0, 2}) == Vec3{2, -2, 3.5f});
}

TEST_CASE("equal grids give equal bytes, other ones another identifier") {
  FogGrid fog = sample();
  const std::string once = encode_vdb_fog({fog});
  CHECK(once == encode_vdb_fog({fog}));
  fog.values[1] = 0.5f;
  const std::string other = encode_vdb_fog({fog});
  CHECK(once.substr(0, 21) == other.substr(0, 21));
  CHECK(once.substr(21, 36) != other.substr(21, 36));
}

TEST_CASE("several grids, one of them empty") {
  FogGrid empty = sample();
  empty.name = "temperature";
  std::fill(empty.values.begin(), empty.values.end(), 0.0f);
  const Saved saved(encode_vdb_fog({sample(), empty}));
  const auto file = open_volume(saved.path);
  REQUIRE(file->grids().size() == 2);
  CHECK(file->grids()[1].name == "temperature");
}

TEST_CASE("a fog that contradicts itself is not written") {
  const auto rejects = [](auto change) {
    FogGrid fog = sample();
    change(fog);
    CHECK_THROWS_AS(encode_vdb_fog({fog}), Error);
  };
  rejects([](FogGrid& f) { f.nx = 0; });
  rejects([](FogGrid& f) { f.values.pop_back(); });
  rejects([](FogGrid& f) { f.voxel_size = 0; });
  rejects([](FogGrid& f) { f.values[3] = -1; });
  rejects([](FogGrid& f) { f.values[3] = std::numeric_limits<float>::quiet_NaN(); });
}

}  // namespace
}  // namespace tyndall
