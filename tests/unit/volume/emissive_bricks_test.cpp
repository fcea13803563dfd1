/// Bricks that emit: their intensity against integration, and the points drawn in them against their density along rays.
#include "volume/emissive_bricks.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "support/chi_squared.h"
#include "support/test_media.h"
#include "unit/volume/voxel_oracle.h"
#include "volume/brick_builder.h"
#include "volume/medium_data.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Optics kHot{.sigma_a = {0.5f, 1, 3}, .sigma_s = {1, 1, 1}};
constexpr Rgb kLe{4, 2, 1};

/// Turned and stretched: bricks are parallelepipeds in the world.
Transform skewed() {
  return Transform::translate(0.3, -2, 5) * Transform::rotate(35, 1, 2, -1) * Transform::scale(0.7, 1.9, 1.2) *
         Transform::rotate(20, 0, 1, 1);
}

ParticipatingMedium emissive_clumps(const Transform& to_world = {}) { return clumpy(kHot, 3, kLe, to_world); }

Vec3 random_point(const Bounds3& box, Rng& rng) {
  return box.min + box.extent() * Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
}

double total_intensity(const EmissiveBricks& bricks) {
  double sum = 0;
  for (std::uint32_t i = 0; i < bricks.size(); ++i) sum += bricks.intensity(i);
  return sum;
}

/// int mean(sigma_a Le) dV by a regular lattice over the medium's box.
double brute_intensity(const ParticipatingMedium& medium) {
  constexpr int kSide = 120;
  const Bounds3 box = medium.bounds();
  const Vec3 step = box.extent() / float{kSide};
  double sum = 0;
  for (int z = 0; z < kSide; ++z)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Coefficients c = medium.at(box.min + step * Vec3{x + 0.5f, y + 0.5f, z + 0.5f});
        sum += double{mean(c.sigma_a * c.Le)};
      }
  return sum * double{step.x} * double{step.y} * double{step.z};
}

/// A medium straight from voxels, of sigma_a 1 and Le 1; where `temperatures` are given they make the light instead. It
/// ends so many cells within the grid.
ParticipatingMedium emissive(const VoxelSource& source, const VoxelSource* temperatures = nullptr, double margin = 0) {
  auto data = std::make_unique<MediumData>();
  const auto place = [](const VoxelSource& from) {
    PlacedGrid placed{build_brick_grid(from, {}), {}};
    const Index3& o = placed.grid.origin();
    placed.to_local = placed.to_local.minus({{double(o[0]), double(o[1]), double(o[2])}});
    return placed;
  };
  data->kind = MediumData::Kind::grid;
  data->optics = {Rgb{1.0f}, {}, {}};
  data->density = place(source);
  data->clip = data->density.grid.support();
  for (int i = 0; i < 3; ++i) {
    data->clip.lo[i] += margin;
    data->clip.hi[i] -= margin;
  }
  data->emission.kind = temperatures ? EmissionField::Kind::blackbody : EmissionField::Kind::constant;
  data->emission.Le = Rgb{1.0f};
  if (temperatures) {
    data->emission.values = place(*temperatures);
    data->emission.table.emplace();
  }
  return ParticipatingMedium(std::move(data));
}

/// Both integrals for each brick by steps along the ray, and the largest density met.
struct Brute {
  std::map<std::uint32_t, BrickOnRay> bricks;
  double peak = 0, step = 0;
};
Brute brute_along(const EmissiveBricks& bricks, const Ray& ray, double length) {
  constexpr int kSteps = 20'000;
  Brute all;
  all.step = length / kSteps;
  auto& found = all.bricks;
  for (std::uint32_t i = 0; i < bricks.size(); ++i) {
    BrickOnRay sum{i, 0, 0};
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) * length / kSteps;
      const double p = bricks.pdf(i, ray.at(static_cast<float>(t)));
      all.peak = std::max(all.peak, p);
      sum.column += p * length / kSteps;
      sum.direction += p * t * t * length / kSteps;
    }
    if (sum.column > 0) found[i] = sum;
  }
  return all;
}

}  // namespace

TEST_CASE("emissive bricks: what they emit together is what the medium emits") {
  for (const Transform& to_world : {Transform(), skewed()}) {
    const ParticipatingMedium medium = emissive_clumps(to_world);
    const EmissiveBricks bricks(medium);
    REQUIRE(bricks.size() > 20);
    CHECK(total_intensity(bricks) == doctest::Approx(brute_intensity(medium)).epsilon(0.01));
  }
}

TEST_CASE("emissive bricks: too many are gathered into larger ones that emit the same") {
  const ParticipatingMedium medium = emissive_clumps(skewed());
  const EmissiveBricks fine(medium), coarse(medium, 30), one(medium, 1);
  CHECK(coarse.size() <= 30);
  CHECK(coarse.size() > 1);
  CHECK(one.size() == 1);
  CHECK(total_intensity(coarse) == doctest::Approx(total_intensity(fine)).epsilon(1e-5));
  CHECK(total_intensity(one) == doctest::Approx(total_intensity(fine)).epsilon(1e-5));
}

TEST_CASE("emissive bricks: a large box of one value is not taken apart") {
  OracleSource box;
  box.add_tile({0, 0, 0}, {511, 511, 511}, 1);
  const ParticipatingMedium medium = emissive(box, nullptr, 60);
  const Vec3 middle{255.5f, 255.5f, 255.5f};
  for (const std::size_t most : {EmissiveBricks::kMost, std::size_t{500}, std::size_t{1}}) {
    const EmissiveBricks bricks(medium, most);
    CHECK(bricks.size() <= most);
    CHECK(bricks.size() >= most / 10);
    CHECK(total_intensity(bricks) == doctest::Approx(393.0 * 393 * 393).epsilon(1e-5));
    double emission = 0;  // a volume, but for the tenth that is drawn anywhere
    for (std::uint32_t i = 0; i < bricks.size(); ++i) emission += bricks.pdf(i, middle) * bricks.intensity(i);
    CHECK(emission == doctest::Approx(1).epsilon(0.11));
  }
}

TEST_CASE("emissive bricks: a small hot part in a large box of one density") {
  OracleSource box, hot;
  box.add_tile({0, 0, 0}, {511, 511, 511}, 1);
  hot.add_tile({200, 200, 200}, {215, 215, 215}, 3000);
  const ParticipatingMedium medium = emissive(box, &hot);
  const EmissiveBricks bricks(medium), few(medium, 3);
  CHECK(bricks.size() >= 8);
  CHECK(bricks.size() <= 27);
  CHECK(few.size() <= 3);
  const double inside = mean(medium.data().emission.at({208, 208, 208}));
  CHECK(total_intensity(bricks) > 15 * 15 * 15 * inside);
  CHECK(total_intensity(few) == doctest::Approx(total_intensity(bricks)).epsilon(1e-5));
}

TEST_CASE("emissive bricks: emission at the ends of index space") {
  OracleSource near, both;
  const auto blob = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto inside = [](std::int64_t i) { return (i & 7) >= 2 && (i & 7) <= 5; };
    return inside(x) && inside(y) && inside(z) ? 1.0f : 0.0f;
  };
  const std::int64_t far = 8 * ((std::int64_t{1} << 22) - 1);  // 2^22 bricks a side: 2^66 places
  near.add_leaf({0, 0, 0}, blob);
  both.add_leaf({0, 0, 0}, blob);
  both.add_leaf({far, far, far}, blob);
  const EmissiveBricks one(emissive(near)), two(emissive(both));
  CHECK(one.size() == 1);
  CHECK(total_intensity(one) == doctest::Approx(64).epsilon(1e-3));
  REQUIRE(two.size() == 2);
  CHECK(two.intensity(0) == doctest::Approx(total_intensity(one)));
  CHECK(two.intensity(1) == doctest::Approx(total_intensity(one)));
}

TEST_CASE("emissive bricks: none without emission, without a grid, or where nothing absorbs") {
  CHECK(EmissiveBricks(clumpy(kHot, 3)).empty());
  CHECK(EmissiveBricks(homogeneous(kHot, kLe)).empty());
  CHECK(EmissiveBricks(clumpy({.sigma_a = {}, .sigma_s = {1, 1, 1}}, 3, kLe)).empty());
  CHECK(EmissiveBricks(clumpy(kHot, 3)).along({{0, 0, -5}, {0, 0, 1}}).empty());
}

TEST_CASE("emissive bricks: integrals along rays") {
  Rng rng(5);
  const ParticipatingMedium medium = emissive_clumps(skewed());
  for (const std::size_t most : {EmissiveBricks::kMost, std::size_t{20}}) {
    const EmissiveBricks bricks(medium, most);
    const Bounds3 box = medium.bounds();
    for (int i = 0; i < 8; ++i) {
      const Vec3 target = random_point(box, rng), from = i % 2 ? random_point(box, rng) : box.min - box.extent() * 0.3f;
      const Ray ray{from, normalize(target - from)};
      const double length = 2.5 * double{tyndall::length(box.extent())};
      const Brute brute = brute_along(bricks, ray, length);
      const auto& expected = brute.bricks;
      const BricksOnRay found = bricks.along(ray);
      CHECK(found.size() >= expected.size());  // a corner that is cut may lie between two steps
      for (const BrickOnRay& b : found) {
        const auto at = expected.find(b.brick);
        const BrickOnRay near = at == expected.end() ? BrickOnRay{b.brick, 0, 0} : at->second;
        const double slack = 3 * brute.peak * brute.step;  // the ends of blocks lie between steps
        CHECK(std::abs(b.column - near.column) < slack);
        CHECK(std::abs(b.direction - near.direction) < slack * 0.36 * length * length);
      }
    }
  }
}

TEST_CASE("emissive bricks: rays along axes, in faces and from corners tile what they pass") {
  const ParticipatingMedium medium = grid(
      {16, 0, 16}, kHot, [](int) { return 1.0f; }, kLe);
  const EmissiveBricks bricks(medium);
  for (const Vec3 o : {Vec3{8, 8, -3}, Vec3{0.5f, 4.5f, -3}, Vec3{8.5f, 8.5f, -3}, Vec3{4, 2.25f, -3}}) {
    double columns = 0;
    for (const BrickOnRay& b : bricks.along({o, {0, 0, 1}})) columns += b.column * bricks.intensity(b.brick);
    CAPTURE(o.x);
    CHECK(columns > 0.85 * 16 * mean(kHot.sigma_a * kLe));
    CHECK(columns < 1.1 * 16 * mean(kHot.sigma_a * kLe));
  }
}

TEST_CASE("emissive bricks: directions of the points drawn follow the density along rays, from without and from within") {
  const ParticipatingMedium medium = emissive_clumps(skewed());
  const EmissiveBricks bricks(medium, 30);
  const auto brick = static_cast<std::uint32_t>(bricks.size() / 2);
  const Vec3 center = bricks.box(brick).center(), size = bricks.box(brick).extent();
  for (const Vec3 from : {center + size * Vec3{1.5f, 0.4f, -0.8f}, center + size * 0.13f}) {
    const auto density = [&](Vec3 w) {
      for (const BrickOnRay& b : bricks.along({from, w})) {
        if (b.brick == brick) return b.direction;
      }
      return 0.0;
    };
    const auto sample = [&](const Uniform& random) -> std::optional<Vec3> {
      const float a = random(), b = random(), c = random();
      return normalize(bricks.sample(brick, {a, b, c}) - from);
    };
    const ChiSquaredOptions options{.axis = normalize(center - from), .theta_power = 1.5, .alpha = sidak(1e-3, 2)};
    const auto result = chi_squared_test(sample, density, options);
    CHECK_MESSAGE(result.passed, result.summary());
    CHECK(result.density_integral == doctest::Approx(1).epsilon(2e-3));
  }
}
