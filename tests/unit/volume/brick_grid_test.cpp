#include "volume/brick_grid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "unit/volume/voxel_oracle.h"
#include "volume/brick_builder.h"

using namespace tyndall;
using test::OracleSource;

namespace {

const Index3 kCorners[] = {{0, 0, 0}, {-40, -8, -160}, {4096 - 16, -4096 - 24, 128 - 8}, {-2147483640, 2147483600, 1000000}};

GridVec index_point(const BrickGrid& grid, const GridVec& local) {
  GridVec p;
  for (int i = 0; i < 3; ++i) p[i] = local[i] + static_cast<double>(grid.origin()[static_cast<std::size_t>(i)]);
  return p;
}

GridVec random_local(const BrickGrid& grid, Rng& rng, double margin = 2) {
  GridVec p;
  for (int i = 0; i < 3; ++i) {
    const double lo = grid.support().lo[i] - margin, hi = grid.support().hi[i] + margin;
    p[i] = lo + (hi - lo) * rng.uniform_wide();
    // A quarter of the points on voxel planes, where bricks meet.
    if (rng.uniform() < 0.25f) p[i] = std::round(p[i]);
  }
  return p;
}

/// Largest possible error of a look-up: half a step of a brick's range, 2^-17 of the largest range.
double bound(double range) { return range * 0x1p-17 * 1.01 + range * 1e-6; }

}  // namespace

TEST_CASE("look-ups agree with the dense oracle, anywhere in index space, for one, three and six channels") {
  Rng rng(1);
  for (const int channels : {1, 3, 6})
    for (const Index3& corner : kCorners) {
      const OracleSource source = test::random_voxels(7 + static_cast<std::uint64_t>(channels), corner, channels);
      const BrickGrid grid = build_brick_grid(source, {});
      double worst = 0;
      for (int i = 0; i < 20000; ++i) {
        const GridVec p = random_local(grid, rng);
        float values[kMaxChannels];
        grid.lookup(p, values);
        for (int c = 0; c < channels; ++c)
          worst = std::max(worst, std::abs(values[c] - source.lookup(index_point(grid, p), c)) / bound(10.0 * (c + 1)));
      }
      CHECK(worst < 1);
    }
}

TEST_CASE("beside a grid, by as little as rounding, the mean of a block is 0") {
  Rng rng(3);
  for (const int channels : {1, 3, 6}) {
    const BrickGrid grid = build_brick_grid(test::random_voxels(11, kCorners[0], channels), {});
    for (int i = 0; i < 3000; ++i) {
      GridVec p = random_local(grid, rng, 0);
      const int axis = i % 3;
      p[axis] = i % 2 == 0 ? std::nextafter(grid.support().lo[axis], -1e9) : std::nextafter(grid.support().hi[axis], 1e9);
      float means[kMaxChannels];
      grid.block_mean(p, means);
      for (int c = 0; c < channels; ++c) REQUIRE(means[c] == 0);
    }
  }
}

TEST_CASE("bricks far apart are found through the tree, without memory for what lies between them") {
  for (const int channels : {1, 3}) {
    OracleSource source(channels);
    Rng rng(8);
    for (const Index3& corner : {Index3{0, 0, 0}, Index3{80000, -160000, 8}, Index3{-800, 240, 1 << 20}})
      source.add_leaf(corner, [&](std::int64_t, std::int64_t, std::int64_t) { return rng.uniform(); });
    const BrickGrid grid = build_brick_grid(source, {});
    CHECK(grid.memory_bytes() < 1u << 20);
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
      GridVec index{{10 * rng.uniform_wide() - 1, 10 * rng.uniform_wide() - 1, 10 * rng.uniform_wide() - 1}};
      const double corner[3][3] = {{0, 0, 0}, {80000, -160000, 8}, {-800, 240, 1 << 20}};
      GridVec local;
      for (int axis = 0; axis < 3; ++axis) {
        index[axis] += corner[i % 3][axis];
        local[axis] = index[axis] - static_cast<double>(grid.origin()[static_cast<std::size_t>(axis)]);
      }
      float values[kMaxChannels];
      grid.lookup(local, values);
      CHECK(values[0] == grid.lookup(local));
      for (int c = 0; c < channels; ++c)
        worst = std::max(worst, std::abs(values[c] - source.lookup(index, c)) / bound(c + 1.0));
    }
    CHECK(worst < 1);
  }
}

TEST_CASE("a look-up of one channel, of all and along a line are the same") {
  const OracleSource source = test::random_voxels(12, {0, -8, 16});
  const BrickGrid grid = build_brick_grid(source, {});
  Rng rng(13);
  for (int i = 0; i < 5000; ++i) {
    const GridVec p = random_local(grid, rng), d = random_local(grid, rng);
    const Line line{{p[0], p[1], p[2], 0}, {d[0] - p[0], d[1] - p[1], d[2] - p[2], 0}};
    float value;
    grid.lookup(p, &value);
    CHECK(std::abs(value - grid.lookup(p)) < 1e-5f);
    CHECK(grid.lookup(line, 0) == grid.lookup(p));
    CHECK(std::abs(grid.lookup(line, 1) - grid.lookup(d)) < 1e-4f);
  }
}

TEST_CASE("points of a brick read together are those read one by one, in it or moved into it") {
  const OracleSource source = test::random_voxels(14, {0, -8, 16});
  Rng rng(15);
  for (const bool floats : {false, true}) {
    const BrickGrid grid = build_brick_grid(source, {.rules = {}, .float_bricks = floats});
    const BrickStore& bricks = grid.bricks();
    for (int i = 0; i < 2000; ++i) {
      const auto brick = static_cast<std::uint32_t>(rng.uniform() * static_cast<float>(bricks.size()));
      Line line;
      for (int axis = 0; axis < 3; ++axis) {
        line.o[axis] = -2 + 12 * rng.uniform_wide();
        line.d[axis] = rng.uniform() < 0.2f ? 0 : 4 * rng.uniform_wide() - 2;
      }
      const double t = rng.uniform_wide(), step = rng.uniform_wide();
      const Float8 together = bricks.read(bricks.plane(brick, 0), BrickPoints(line, t, step));
      for (int k = 0; k < BrickPoints::kCount; ++k) {
        const float alone = bricks.read(bricks.plane(brick, 0), BrickPoint(line, t + k * step));
        CHECK(std::abs(together[static_cast<std::size_t>(k)] - alone) < 1e-4f);
      }
    }
    // What is not a number is some place of the brick.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const float lost = bricks.read(bricks.plane(1, 0), BrickPoints({{nan, 1e30, 1, 0}, {1, -1, nan, 0}}, 0, 1))[7];
    CHECK_FALSE(lost > grid.range().max);
  }
}

TEST_CASE("float bricks hold voxels exactly") {
  const OracleSource source = test::random_voxels(3, {-16, 8, 64});
  const BrickGrid grid = build_brick_grid(source, {.rules = {}, .float_bricks = true});
  Rng rng(2);
  int different = 0;
  for (int i = 0; i < 20000; ++i) {
    GridVec p = random_local(grid, rng, 0);
    for (double& x : p.v) x = std::round(x);
    const GridVec index = index_point(grid, p);
    const Index3 at{static_cast<std::int64_t>(index[0]), static_cast<std::int64_t>(index[1]),
                    static_cast<std::int64_t>(index[2])};
    different += grid.lookup(p) != static_cast<float>(source.voxel(at)) ? 1 : 0;
  }
  CHECK(different == 0);
}

TEST_CASE("16-bit steps err by less than 2^-16 of a brick's range, and zero is exactly zero") {
  Rng rng(5);
  for (const bool negative : {false, true})
    for (const float scale : {1e-30f, 1e-3f, 1.0f, 1e30f}) {
      OracleSource source;
      source.add_leaf({0, 0, 0}, [&](std::int64_t, std::int64_t, std::int64_t) {
        return rng.uniform() < 0.2f ? 0.0f : scale * (negative ? rng.uniform() * 1.7f - 0.9f : rng.uniform());
      });
      VoxelRules rules;
      rules.negative_to_zero = false;
      const BrickGrid grid = build_brick_grid(source, {rules, false});
      double lowest = 0, highest = 0, worst = 0;
      for (std::int64_t i = 0; i < 512; ++i) {
        const Index3 at{i & 7, i >> 3 & 7, i >> 6};
        const double exact = source.voxel(at);
        lowest = std::min(lowest, exact);
        highest = std::max(highest, exact);
        const float got =
            grid.lookup(GridVec{{double(at[0]) - double(grid.origin()[0]), double(at[1]) - double(grid.origin()[1]),
                                 double(at[2]) - double(grid.origin()[2])}});
        if (exact == 0) CHECK(got == 0);
        worst = std::max(worst, std::abs(got - exact));
      }
      CHECK(worst < (highest - lowest) * 0x1p-16);
    }
}

TEST_CASE("a voxel decodes alike in the bricks that share it, but for 2^-16 of their range") {
  const OracleSource source = test::random_voxels(11, {0, 0, 0});
  const BrickGrid grid = build_brick_grid(source, {});
  const ValueRange all = grid.range();
  Rng rng(3);
  float worst = 0;
  for (int i = 0; i < 20000; ++i) {
    GridVec p = random_local(grid, rng, -1);
    const int axis = static_cast<int>(rng.uniform() * 3);
    p[axis] = std::round(p[axis] / 8) * 8;
    GridVec below = p;
    below[axis] = std::nextafter(p[axis], -1e9);
    worst = std::max(worst, std::abs(grid.lookup(p) - grid.lookup(below)));
  }
  CHECK(worst <= all.max * 0x1p-16f);
}

TEST_CASE("ranges of every node bound what interpolation gives") {
  for (const Index3& corner : kCorners) {
    const OracleSource source = test::random_voxels(23, corner);
    const BrickGrid grid = build_brick_grid(source, {});
    Rng rng(9);
    int violations = 0;
    const int points = corner == kCorners[0] ? 10'000'000 : 1'000'000;
    for (int i = 0; i < points; ++i) {
      const GridVec p = random_local(grid, rng, -0.01);
      const Index3 cell{static_cast<std::int64_t>(p[0]), static_cast<std::int64_t>(p[1]), static_cast<std::int64_t>(p[2])};
      const float value = grid.lookup(p);
      std::uint32_t node = grid.root();
      for (int level = grid.root_level(); node != BrickGrid::kNone; --level) {
        const ValueRange r = grid.ranges(node)[0];
        violations += value < r.min || value > r.max ? 1 : 0;
        if (grid.node(node).is_leaf()) break;
        node = grid.child(node, level, cell);
      }
    }
    CHECK(violations == 0);
  }
}

TEST_CASE("the range of a brick, and of an octant, holds its least and its largest voxel wherever they lie") {
  constexpr int kY = BrickStore::kVoxelSide, kZ = kY * kY;
  std::vector<float> voxels(BrickStore::kVoxels, 2.0f);
  for (const int cells : {BrickStore::kSide, BrickOctants::kCells}) {
    int wrong = 0;
    for (int z = 0; z <= cells; ++z)
      for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x) {
          float& voxel = voxels[static_cast<std::size_t>(z * kZ + y * kY + x)];
          voxel = 1;
          const ValueRange low = range_of_cells(voxels.data(), cells);
          voxel = 3;
          const ValueRange high = range_of_cells(voxels.data(), cells);
          voxel = 2;
          wrong += low.min <= 1 && low.max >= 2 && high.min <= 2 && high.max >= 3 ? 0 : 1;
          wrong += low.min > 0.999f && high.max < 3.001f ? 0 : 1;
        }
    CHECK(wrong == 0);
  }
}

TEST_CASE("the mean of a node is the mean of its cells") {
  OracleSource ramp;
  for (std::int64_t x = 0; x < 16; x += 8)
    ramp.add_leaf({x, 0, 0}, [](std::int64_t vx, std::int64_t, std::int64_t) { return static_cast<float>(vx); });
  const BrickGrid grid = build_brick_grid(ramp, {});
  double sum = 0;
  int count = 0;
  const double size = static_cast<double>(BrickGrid::extent(grid.root_level()));
  for (double z = 0.5; z < size; ++z)
    for (double y = 0.5; y < size; ++y)
      for (double x = 0.5; x < size; ++x, ++count) sum += grid.lookup(GridVec{{x, y, z}});
  CHECK(grid.range().mean == doctest::Approx(sum / count).epsilon(1e-4));
}

TEST_CASE("the inside of boxes of one value costs no voxels") {
  OracleSource source;
  source.add_tile({-256, 0, 0}, {255, 511, 511}, 2.5f);
  const BrickGrid grid = build_brick_grid(source, {});
  CHECK(grid.memory_bytes() < 50u << 20);  // the faces alone; 512^3 voxels would take 270 MB
  Rng rng(4);
  for (int i = 0; i < 1000; ++i) {
    const GridVec p = random_local(grid, rng);
    CHECK(grid.lookup(p) == doctest::Approx(source.lookup(index_point(grid, p))));
  }
}

TEST_CASE("rules: negative, not finite, outside the clip box") {
  OracleSource source;
  const float bad[] = {-2, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3};
  source.add_leaf({0, 0, 0}, [&](std::int64_t x, std::int64_t, std::int64_t) { return bad[x & 3]; });
  VoxelRules rules;
  const VoxelReport report = inspect(source, rules);
  CHECK(report.negative == 128);
  CHECK(report.lowest == -2);
  CHECK(report.non_finite == 256);
  CHECK(report.first_non_finite == Index3{1, 0, 0});
  BrickGrid grid = build_brick_grid(source, {rules, false});
  CHECK(grid.range().min == 0);
  CHECK(grid.range().max == doctest::Approx(3));

  rules.clip = VoxelBox{{3, 0, 0}, {3, 7, 3}};
  CHECK(inspect(source, rules).non_finite == 0);
  grid = build_brick_grid(source, {rules, false});
  const auto at = [&](double x, double y, double z) {
    return grid.lookup(GridVec{{x - double(grid.origin()[0]), y - double(grid.origin()[1]), z - double(grid.origin()[2])}});
  };
  CHECK(at(3, 0, 0) == 3);
  CHECK(at(3, 0, 3) == 3);
  CHECK(at(3, 0, 4) == 0);
  CHECK(at(7, 0, 0) == 0);
}

TEST_CASE("a grid without any value other than zero is empty") {
  OracleSource source;
  CHECK(build_brick_grid(source, {}).empty());
  source.add_tile({0, 0, 0}, {63, 63, 63}, 0);
  source.add_leaf({64, 0, 0}, [](std::int64_t, std::int64_t, std::int64_t) { return 0.0f; });
  const BrickGrid grid = build_brick_grid(source, {});
  CHECK(grid.empty());
  CHECK(grid.lookup(GridVec{{1, 1, 1}}) == 0);
  CHECK(grid.range().max == 0);
}

TEST_CASE("a grid that would take more memory than it may is not made, whatever its bricks come from") {
  OracleSource speckled, boxed, banded;
  Rng rng(9);
  for (int i = 0; i < 30; ++i) {
    const Index3 lo{8 * (i % 5), 8 * (i / 5), 24 * (i % 3)};
    speckled.add_leaf(lo, [&](std::int64_t, std::int64_t, std::int64_t) { return rng.uniform(); });
  }
  boxed.add_tile({0, 0, 0}, {100, 100, 100}, 1);
  for (int i = 0; i < 8; ++i) banded.add_tile({64 * i, 0, 0}, {64 * i + 63, 63, 63}, 1 + static_cast<float>(i));
  for (const OracleSource* source : {&speckled, &boxed, &banded})
    for (const bool floats : {false, true}) {
      const BrickBuildOptions free{.rules = {}, .float_bricks = floats};
      const std::size_t bytes = build_brick_grid(*source, free).memory_bytes();
      BrickBuildOptions tight = free;
      tight.most_memory = bytes;
      CHECK(build_brick_grid(*source, tight).memory_bytes() == bytes);
      tight.most_memory = bytes * 9 / 10;
      CHECK_THROWS_AS(build_brick_grid(*source, tight), GridTooLarge);
    }
}
