/// The promise that tracking rests on, on real volumes: no density anywhere is above the majorant of a cell that holds the
/// point, or below its minorant, at any level.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/sanitized.h"
#include "unit/volume/vdb_import.h"
#include "volume/medium_data.h"

using namespace tyndall;

namespace {

constexpr int kPoints = test::fewer(10'000'000);  // a volume

/// The lower corners of all leaves that hold voxels.
void find_bricks(const BrickGrid& grid, std::uint32_t node, int level, const Index3& corner, std::vector<Index3>& found) {
  if (grid.node(node).is_leaf()) {
    if (level == 0) found.push_back(corner);
    return;
  }
  const std::int64_t size = BrickGrid::extent(level - 1);
  for (std::int64_t i = 0; i < 64; ++i) {
    const Index3 at{corner[0] + (i & 3) * size, corner[1] + (i >> 2 & 3) * size, corner[2] + (i >> 4) * size};
    const std::uint32_t child = grid.child(node, level, at);
    if (child != BrickGrid::kNone) find_bricks(grid, child, level - 1, at, found);
  }
}

/// A coordinate in [0, 8] of a brick: anywhere, or where a bound would break first: on a voxel, on the brick's seam, or
/// the number next to one.
float coordinate(Rng& rng, bool adversarial) {
  const float anywhere = 8 * rng.uniform();
  if (!adversarial) return anywhere;
  switch (rng.next() % 5) {
    case 0:
      return anywhere;
    case 1:
      return rng.uniform() < 0.5f ? 0.0f : 8.0f;
    case 2:
      return std::round(anywhere);
    case 3:
      return std::min(8.0f, std::nextafter(std::round(anywhere), 9.0f));
    default:
      return std::max(0.0f, std::nextafter(std::round(anywhere), -1.0f));
  }
}

/// Reads as tracking does, inside the brick at `corner`, and counts the levels whose range the value leaves.
int violations_at(const BrickGrid& grid, const Index3& corner, Rng& rng, bool adversarial) {
  const float x = coordinate(rng, adversarial), y = coordinate(rng, adversarial), z = coordinate(rng, adversarial);
  float values[kMaxChannels];
  const std::uint32_t leaf = grid.leaf(grid.root(), grid.root_level(), corner);
  grid.bricks().lookup_all(grid.node(leaf).first, x, y, z, values);
  int violations = 0;
  std::uint32_t node = grid.root();
  for (int level = grid.root_level();; --level) {
    const auto ranges = grid.ranges(node);
    for (std::size_t c = 0; c < ranges.size(); ++c) {
      violations += values[c] > ranges[c].max || values[c] < ranges[c].min ? 1 : 0;
    }
    if (grid.node(node).is_leaf()) return violations;
    node = grid.child(node, level, corner);
  }
}

/// At a point anywhere in the volume's box, through the general look-up: empty space must be empty.
int violations_anywhere(const BrickGrid& grid, Rng& rng) {
  GridVec p;
  for (int i = 0; i < 3; ++i) {
    const double lo = grid.support().lo[i], hi = grid.support().hi[i];
    p[i] = lo + (hi - lo) * rng.uniform_wide();
  }
  const Index3 cell{static_cast<std::int64_t>(p[0]), static_cast<std::int64_t>(p[1]), static_cast<std::int64_t>(p[2])};
  const float value = grid.lookup(p);
  int violations = 0;
  std::uint32_t node = grid.root();
  for (int level = grid.root_level(); node != BrickGrid::kNone; --level) {
    const ValueRange r = grid.ranges(node)[0];
    violations += value > r.max || value < r.min ? 1 : 0;
    if (grid.node(node).is_leaf()) return violations;
    node = grid.child(node, level, cell);
  }
  return violations + (value != 0 ? 1 : 0);
}

}  // namespace

TEST_CASE("10 million points of each real volume lie within the bounds of every cell that holds them") {
  const std::string root = std::string(TYNDALL_SOURCE_DIR) + "/";
  for (const std::string file : {"volumes/plume_hall/plume.vdb", "volumes/mantaflow_smoke/mantaflow_smoke_0025.vdb",
                                 "volumes/mantaflow_smoke/mantaflow_smoke_0050.vdb", "volumes/teapot_cloud/teapot_cloud.nvdb",
                                 "tests/regression/pbrt/smoke.nvdb", "tests/regression/pbrt/hot.nvdb"}) {
    CAPTURE(file);
    const test::Import import = test::import(root + file);
    const BrickGrid& grid = import.medium.data().density.grid;
    REQUIRE_FALSE(grid.empty());
    std::vector<Index3> bricks;
    find_bricks(grid, grid.root(), grid.root_level(), {0, 0, 0}, bricks);
    REQUIRE_FALSE(bricks.empty());
    Rng rng(17);
    int violations = 0;
    for (int i = 0; i < kPoints; ++i) {
      if (i % 10 == 0) {
        violations += violations_anywhere(grid, rng);
      } else {
        violations += violations_at(grid, bricks[rng.next() % bricks.size()], rng, i % 2 == 1);
      }
    }
    CHECK(violations == 0);
    MESSAGE(file << ": " << bricks.size() << " bricks, " << grid.root_level() + 1 << " levels, " << kPoints << " points, "
                 << violations << " violations");
  }
}
