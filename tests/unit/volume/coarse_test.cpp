/// What media amount to coarsely: block means against the cells they stand for, depths against integration.
#include "volume/coarse.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/test_media.h"
#include "unit/volume/voxel_oracle.h"
#include "volume/brick_builder.h"
#include "volume/medium_data.h"

using namespace tyndall;

namespace {

constexpr int kCells = BlockMeans::kCells;

GridVec cell_centre(const Index3& cell) { return {{double(cell[0]) + 0.5, double(cell[1]) + 0.5, double(cell[2]) + 0.5}}; }

/// Mean of a trilinear grid over the cells of a box: that of the values at their centres.
double brute_mean(const BrickGrid& grid, const Index3& lo, std::int64_t side, int channel) {
  double sum = 0;
  for (std::int64_t z = 0; z < side; ++z)
    for (std::int64_t y = 0; y < side; ++y)
      for (std::int64_t x = 0; x < side; ++x) {
        float values[kMaxChannels];
        grid.lookup(cell_centre({lo[0] + x, lo[1] + y, lo[2] + z}), values);
        sum += values[channel];
      }
  return sum / double(side * side * side);
}

Index3 random_cell(const BrickGrid& grid, Rng& rng) {
  Index3 cell;
  for (std::size_t i = 0; i < 3; ++i) {
    const double lo = grid.support().lo.v[i], hi = grid.support().hi.v[i];
    cell[i] = static_cast<std::int64_t>(lo + (hi - lo) * rng.uniform_wide());
  }
  return cell;
}

/// Soft hills, no voxel far from its neighbours.
ParticipatingMedium hills(const test::Optics& optics, const Transform& to_world = {}) {
  constexpr int kSide = 64;
  return test::grid(
      {kSide, -1, 1}, optics,
      [](int i) {
        const auto wave = [](int k) { return 0.5f - 0.5f * std::cos(2 * kPi * (static_cast<float>(k) + 0.5f) / kSide); };
        return wave(i % kSide) * wave(i / kSide % kSide) * wave(i / (kSide * kSide));
      },
      {}, to_world);
}

Ray random_ray(const Bounds3& box, Rng& rng) {
  const auto point = [&] { return box.min + box.extent() * Vec3{rng.uniform(), rng.uniform(), rng.uniform()}; };
  const Vec3 a = point(), b = point();
  return {a - (b - a) * 2, normalize(b - a)};
}

}  // namespace

TEST_CASE("a block's mean is that of its cells, but for 1/255 of its brick's range; zero only where all is") {
  Rng rng(1);
  for (const int channels : {1, 3, 6})
    for (const Index3& corner : {Index3{0, 0, 0}, Index3{-40, -8, -160}}) {
      const BrickGrid grid = build_brick_grid(test::random_voxels(5, corner, channels), {});
      double worst = 0;
      int wrong_zeros = 0;
      for (int i = 0; i < 2000; ++i) {
        const Index3 cell = random_cell(grid, rng);
        const Index3 lo{cell[0] & -kCells, cell[1] & -kCells, cell[2] & -kCells};
        const std::uint32_t leaf = grid.leaf(grid.root(), grid.root_level(), cell);
        float means[kMaxChannels];
        grid.block_mean(cell_centre(cell), means);
        for (int c = 0; c < channels; ++c) {
          const double exact = brute_mean(grid, lo, kCells, c);
          const ValueRange range = leaf == BrickGrid::kNone ? ValueRange{} : grid.ranges(leaf)[static_cast<std::size_t>(c)];
          worst = std::max(worst, std::abs(means[c] - exact) / (1e-5 * exact + (range.max - range.min) / 255.0 + 1e-30));
          wrong_zeros += (means[c] == 0) != (exact == 0) ? 1 : 0;
        }
      }
      CHECK(worst < 1);
      CHECK(wrong_zeros == 0);
    }
}

TEST_CASE("along a line the first channel's means are the same, through the tree as well, and 0 outside") {
  test::OracleSource far_apart;
  far_apart.add_leaf({0, 0, 0}, [](std::int64_t x, std::int64_t y, std::int64_t) { return static_cast<float>(1 + x * y); });
  far_apart.add_leaf({1 << 20, 0, 0}, [](auto, auto, auto) { return 2.0f; });
  Rng rng(2);
  for (const BrickGrid& grid : {build_brick_grid(test::random_voxels(5, {-40, -8, -160}, 1), {}),
                                build_brick_grid(test::random_voxels(6, {0, 0, 0}, 3), {}), build_brick_grid(far_apart, {})}) {
    int seen = 0;
    for (int i = 0; i < 2000; ++i) {
      Index3 cell = random_cell(grid, rng);
      if (cell[0] > 1000) cell[0] = 8 + cell[0] % 8;  // of those far apart in the first
      const GridVec p = cell_centre(cell);
      const Line line{{p[0] - 2, p[1] + 3, p[2] - 1, 0}, {4, -6, 2, 0}};
      float means[kMaxChannels];
      grid.block_mean(p, means);
      CHECK(grid.block_mean(line, 0.5) == means[0]);
      seen += means[0] > 0 ? 1 : 0;
      CHECK(grid.block_mean(line, 1e6) == 0);
      CHECK(grid.block_mean(line, -1e6) == 0);
    }
    CHECK(seen > 0);
  }
}

TEST_CASE("little beside much does not become nothing") {
  test::OracleSource source;
  source.add_leaf({0, 0, 0}, [](std::int64_t x, std::int64_t, std::int64_t) { return x < 4 ? 1e-3f : 1000.0f; });
  const BrickGrid grid = build_brick_grid(source, {.rules = {}, .float_bricks = true});
  for (std::int64_t x = 8; x < 16; ++x) {  // voxel 0 stands at 8
    float mean[kMaxChannels];
    grid.block_mean(cell_centre({x, 10, 10}), mean);
    CHECK(mean[0] > 0);
  }
}

namespace {

CoarseOptics coarse_optics(MediaView media, Vec3 p) { return CoarseRay(media, {p - Vec3{2, 4, -6}, {1, 2, -3}}).at(2); }

}  // namespace

TEST_CASE("coarse optics are channel means: exact for homogeneous media, sums where media overlap, nothing outside") {
  const auto fog = test::homogeneous({{0.1f, 0.2f, 0.6f}, {1, 2, 6}, 0.5f});
  const auto smoke = hills({{3, 0, 0}, {6, 6, 0}, 0}), emissive = hills({Rgb{2.0f}, {}, 0});
  const ParticipatingMedium *a[] = {&fog}, *b[] = {&smoke}, *all[] = {&fog, &smoke, &emissive};
  const Vec3 inside{0.1f, -0.2f, 0.3f}, outside{0, 0, 1.5f};
  CHECK(coarse_optics(a, inside).sigma_t == doctest::Approx(3.3));
  CHECK(coarse_optics(a, inside).sigma_s == doctest::Approx(3));
  CHECK(coarse_optics(b, outside).sigma_t == 0);
  Rng rng(9);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 far{8 * rng.uniform() - 4, 8 * rng.uniform() - 4, 8 * rng.uniform() - 4};
    if (!smoke.bounds().contains(far)) CHECK(coarse_optics(b, far).sigma_t == 0);
  }
  const Coefficients exact = smoke.at(inside);
  CHECK(coarse_optics(b, inside).sigma_t == doctest::Approx(mean(exact.sigma_t())).epsilon(0.1));
  CHECK(coarse_optics(b, inside).sigma_s == doctest::Approx(mean(exact.sigma_s)).epsilon(0.1));
  const ParticipatingMedium* c[] = {&emissive};
  CHECK(coarse_optics(c, inside).sigma_t > 0);
  CHECK(coarse_optics(c, inside).sigma_s == 0);
  CHECK(coarse_optics(all, inside).sigma_t ==
        coarse_optics(a, inside).sigma_t + coarse_optics(b, inside).sigma_t + coarse_optics(c, inside).sigma_t);
  CHECK(coarse_optics(all, outside).sigma_s == coarse_optics(a, outside).sigma_s);
}

TEST_CASE("coefficients of their own in every voxel are averaged over channels too") {
  RgbGridMedium rgb;
  rgb.bounds = {{-1, -1, -1}, {1, 1, 1}};
  constexpr int kSide = 32;
  rgb.nx = rgb.ny = rgb.nz = kSide;
  rgb.scale = 2;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const float x = static_cast<float>(i % kSide) / kSide;
    rgb.sigma_a.push_back({x, 0, 0.5f});
    rgb.sigma_s.push_back({1 - x, 1, 0});
  }
  Medium medium;
  medium.kind = rgb;
  const auto built = test::built(medium, {Rgb{1.0f}, Rgb{1.0f}, 0});
  const ParticipatingMedium* media[] = {&built};
  Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p{1.6f * rng.uniform() - 0.8f, 1.6f * rng.uniform() - 0.8f, 1.6f * rng.uniform() - 0.8f};
    const CoarseOptics coarse = coarse_optics(media, p);
    const Coefficients exact = built.at(p);
    CHECK(coarse.sigma_t == doctest::Approx(mean(exact.sigma_t())).epsilon(0.01));
    CHECK(std::abs(coarse.sigma_s - mean(exact.sigma_s)) < 0.04);  // 2/3 over 16 blocks
  }
}

TEST_CASE("optical depth approaches the integral for smooth grids, under rotation, mirroring and uneven scale") {
  const test::Optics optics{{2, 1, 3}, {4, 6, 2}, 0};
  const Transform placings[] = {{},
                                Transform::rotate(50, 1, 2, -1) * Transform::scale(1, -1, 1),
                                Transform::translate(100, 0, -3) * Transform::scale(0.01, 3, 0.5)};
  Rng rng(4);
  for (const Transform& to_world : placings) {
    const auto smoke = hills(optics, to_world);
    const ParticipatingMedium* media[] = {&smoke};
    double fine = 0, few = 0, whole = 0;
    for (int i = 0; i < 60; ++i) {
      const Ray ray = random_ray(smoke.bounds(), rng);
      const auto extent = coarse_extent(media, ray, 0, kInfinity);
      if (!extent) continue;
      const test::LineIntegrals exact = test::integrate_line(media, ray, extent->first, extent->second, 2000);
      const double depth = (exact.depth[0] + exact.depth[1] + exact.depth[2]) / 3;
      const float many = coarse_optical_depth(media, ray, 0, kInfinity, 1000);
      CHECK(many == coarse_optical_depth(media, ray, 0, kInfinity, 1000));
      fine += std::abs(many - depth);
      few += std::abs(coarse_optical_depth(media, ray, 0, kInfinity, 6) - depth);
      whole += depth;
    }
    CHECK(whole > 0);
    CHECK(fine < 0.01 * whole);
    CHECK(few < 0.1 * whole);
  }
}

TEST_CASE("points along a ray lie in the middle of equal parts") {
  const auto smoke = hills({Rgb{2.0f}, Rgb{3.0f}, 0});
  const ParticipatingMedium* media[] = {&smoke};
  const Ray ray{{0.3f, -0.7f, 0.2f}, {0, 1, 0}};
  const auto at = [&](float t) { return coarse_optics(media, ray.at(t)).sigma_t; };
  CHECK(coarse_optical_depth(media, ray, 0, 1.2f, 1) == doctest::Approx(1.2 * at(0.6f)));
  CHECK(coarse_optical_depth(media, ray, 0, 1.2f, 3) == doctest::Approx(0.4 * (at(0.2f) + at(0.6f) + at(1.0f))));
}

TEST_CASE("homogeneous media have a closed form, at any length") {
  const auto fog = test::homogeneous({{0.1f, 0.2f, 0.6f}, {1, 2, 6}, 0}), nothing = test::homogeneous({});
  const auto smoke = hills({Rgb{1.0f}, Rgb{1.0f}, 0});
  const ParticipatingMedium *a[] = {&fog}, *b[] = {&nothing}, *both[] = {&fog, &smoke};
  const Ray ray{{-3, 0.1f, 0.2f}, {1, 0, 0}};
  CHECK(coarse_optical_depth(a, ray, 1, 3.5f, 1) == doctest::Approx(2.5 * 3.3));
  CHECK(coarse_optical_depth(a, ray, 0, kInfinity, 1) == kInfinity);
  CHECK(coarse_optical_depth(b, ray, 0, kInfinity, 1) == 0);
  CHECK(coarse_optical_depth(a, ray, 3, 3, 8) == 0);
  CHECK(coarse_optical_depth(both, ray, 0, 9, 32) ==
        doctest::Approx(9 * 3.3 + coarse_optical_depth(MediaView(both).subspan(1), ray, 0, 9, 32)));
}

TEST_CASE("the depth up close is that of the blocks, and is sought no further than asked") {
  const auto fog = test::homogeneous({{0.1f, 0.2f, 0.6f}, {1, 2, 6}, 0.5f}), smoke = hills({Rgb{2.0f}, Rgb{7.0f}, 0});
  const ParticipatingMedium *a[] = {&fog}, *b[] = {&smoke}, *both[] = {&fog, &smoke};
  CHECK(nearby_optical_depth(a, {{-3, 0.1f, 0.2f}, {1, 0, 0}}, 2.5f, 99) == doctest::Approx(2.5 * 3.3));
  CHECK(nearby_optical_depth(b, {{-3, 2, 0}, {1, 0, 0}}, kInfinity, 99) == 0);
  Rng rng(8);
  double squares = 0;
  for (int i = 0; i < 400; ++i) {
    Ray ray = random_ray(smoke.bounds(), rng);
    ray.o = ray.at(2);  // among the smoke
    const float dense = coarse_optical_depth(b, ray, 0, kInfinity, 400), found = nearby_optical_depth(b, ray, kInfinity, 99);
    CHECK(std::abs(found - dense) < 0.1f + 0.2f * dense);
    squares += double{found - dense} * (found - dense) / (0.01 + double{dense} * dense);
    CHECK(nearby_optical_depth(both, ray, 2, 99) == doctest::Approx(6.6 + nearby_optical_depth(b, ray, 2, 99)));
    if (dense > 2) CHECK(nearby_optical_depth(b, ray, kInfinity, 1) < found);
  }
  CHECK(std::sqrt(squares / 400) < 0.08);
}

TEST_CASE("nothing is found in an empty grid or beside one") {
  const auto empty = test::grid({8, -1, 1}, {Rgb{1.0f}, Rgb{1.0f}, 0}, [](int) { return 0.0f; });
  const auto smoke = hills({Rgb{1.0f}, Rgb{1.0f}, 0});
  const ParticipatingMedium *a[] = {&empty}, *b[] = {&smoke};
  const Ray through{{-3, 0, 0}, {1, 0, 0}}, beside{{-3, 2, 0}, {1, 0, 0}};
  CHECK(coarse_optics(a, {}).sigma_t == 0);
  CHECK(coarse_optical_depth(a, through, 0, kInfinity, 8) == 0);
  CHECK(!coarse_extent(a, through, 0, kInfinity));
  CHECK(!coarse_extent(b, beside, 0, kInfinity));
  CHECK(!coarse_extent(b, through, 0, 1));
  CHECK(!coarse_extent({}, through, 0, 1));
  CHECK(coarse_optical_depth(b, beside, 0, kInfinity, 8) == 0);
}

TEST_CASE("the extent holds all that is not empty") {
  const auto left = hills({Rgb{1.0f}, Rgb{1.0f}, 0}, Transform::translate(-4, 0, 0)), right = hills({Rgb{1.0f}, {}, 0});
  const auto fog = test::homogeneous({Rgb{1.0f}, {}, 0});
  const ParticipatingMedium *both[] = {&left, &right}, *foggy[] = {&right, &fog};
  const Ray ray{{-9, 0.3f, 0.1f}, {1, 0, 0}};
  const auto extent = coarse_extent(both, ray, 0, kInfinity);
  REQUIRE(extent);
  CHECK(extent->first == doctest::Approx(4).epsilon(0.01));
  CHECK(extent->second == doctest::Approx(10).epsilon(0.01));
  CHECK(coarse_extent(both, ray, 5, 6) == std::pair{5.0f, 6.0f});
  CHECK(coarse_extent(foggy, ray, 0, kInfinity) == std::pair{0.0f, kInfinity});
  Rng rng(6);
  for (int i = 0; i < 200; ++i) {
    const Ray any = random_ray(right.bounds(), rng);
    const ParticipatingMedium* media[] = {&right};
    const auto part = coarse_extent(media, any, 0, kInfinity);
    for (int k = 0; k < 400; ++k) {
      const float t = 0.02f * static_cast<float>(k);
      if (right.at(any.at(t)).sigma_a.r > 0) CHECK((part && t >= part->first && t <= part->second));
    }
  }
}
