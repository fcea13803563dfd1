/// Importing volume files in tests.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "math/rng.h"
#include "support/vdb_writer.h"
#include "tyndall/error.h"
#include "volume/medium.h"

namespace tyndall::test {

inline const std::string kData = std::string(TYNDALL_SOURCE_DIR) + "/tests/data/";

struct Import {
  ParticipatingMedium medium;
  std::vector<std::string> notes;
};

inline Import import(const std::string& path, VdbMedium vdb = {}, MediumBuildOptions options = {},
                     const Transform& to_world = {}) {
  vdb.path = path;
  Medium medium;
  medium.kind = std::move(vdb);
  medium.to_world = to_world;
  std::vector<std::string> notes;
  ParticipatingMedium result = build_medium(medium, options, notes);
  return {std::move(result), notes};
}

inline std::string error_of(const std::string& path, VdbMedium vdb = {}, MediumBuildOptions options = {}) {
  try {
    import(path, std::move(vdb), options);
  } catch (const Error& e) {
    CHECK(e.failure() == Failure::scene);
    return e.what();
  }
  return "no error";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
inline bool contains(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines)
    if (contains(line, part)) return true;
  return false;
}

inline VdbMedium named(const std::string& name) {
  VdbMedium vdb;
  vdb.density_grid = name;
  vdb.density_grid_given = true;
  return vdb;
}

inline std::vector<VdbGrid::Voxel> speckles(Rng& rng, const std::array<int, 3>& corner, int size, int count) {
  std::vector<VdbGrid::Voxel> voxels;
  for (int i = 0; i < count; ++i) {
    std::array<int, 3> at;
    for (std::size_t a = 0; a < 3; ++a) at[a] = corner[a] + static_cast<int>(rng.uniform() * static_cast<float>(size));
    voxels.push_back({at, rng.uniform() * 2});
  }
  return voxels;
}

}  // namespace tyndall::test
