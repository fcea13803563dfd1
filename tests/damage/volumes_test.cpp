/// Damaged .vdb and .nvdb files: read, or refused in one line. What is read is finite and can be tracked through.
#include <doctest/doctest.h>

#include <cmath>

#include "support/damage.h"
#include "support/scratch.h"
#include "unit/volume/vdb_import.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

void import_volume(const std::string& path) {
  const Import read = import(path);
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 at{rng.uniform() * 10 - 2, rng.uniform() * 10 - 2, rng.uniform() * 10 - 2};
    if (!is_finite(read.medium.at(at).sigma_t()) || !(read.medium.at(at).sigma_a.r >= 0))
      throw std::runtime_error("a density that is no density");
  }
}

std::vector<VdbGrid> grids(VdbGrid::Type type) {
  VdbGrid density, temperature;
  Rng rng(3);
  density.type = temperature.type = type;
  density.index_to_world = Transform::scale(0.25, 0.25, 0.25);
  density.boxes = {{{0, 0, 0}, {40, 20, 20}, 0.5f}};
  density.voxels = speckles(rng, {0, 0, 0}, 20, 300);
  temperature.name = "temperature";
  temperature.voxels = speckles(rng, {-9, 0, 100}, 12, 100);
  if (type == VdbGrid::Type::vec3) return {density};
  return {density, temperature};
}

}  // namespace

TEST_CASE("damaged .vdb files") {
  const Scratch folder;
  write_vdb(folder / "float.vdb", grids(VdbGrid::Type::scalar));
  write_vdb(folder / "half.vdb", grids(VdbGrid::Type::half));
  write_vdb(folder / "vec3.vdb", grids(VdbGrid::Type::vec3));
  for (const char* name : {"float.vdb", "half.vdb", "vec3.vdb"}) import_volume(folder / name);
  const Verdict verdict = read_mutants({folder / "float.vdb", folder / "half.vdb", folder / "vec3.vdb"}, import_volume);
  MESSAGE(verdict.str());
  CHECK(verdict.complaints.empty());
  CHECK(verdict.accepted_truncations == 0);
}

TEST_CASE("damaged .nvdb files") {
  std::vector<std::string> seeds;
  for (const char* name : {"ball_float_zip", "ball_float_blosc", "ball_fp8_zip", "ball_fpn_zip", "ball_vec3_zip"})
    seeds.push_back(kData + name + ".nvdb");
  for (const std::string& seed : seeds) import_volume(seed);
  const Verdict verdict = read_mutants(seeds, import_volume);
  MESSAGE(verdict.str());
  CHECK(verdict.complaints.empty());
  CHECK(verdict.accepted_truncations == 0);
}
