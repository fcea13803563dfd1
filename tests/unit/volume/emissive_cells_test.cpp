/// Cells that emit: their intensity and radiance against integration, and the points drawn in them against their density.
#include "volume/emissive_cells.h"

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

/// Turned and stretched: cells are parallelepipeds in the world.
Transform skewed() {
  return Transform::translate(0.3, -2, 5) * Transform::rotate(35, 1, 2, -1) * Transform::scale(0.7, 1.9, 1.2) *
         Transform::rotate(20, 0, 1, 1);
}

ParticipatingMedium emissive_clumps(const Transform& to_world = {}) { return clumpy(kHot, 3, kLe, to_world); }

const MediumReach kAnywhere{{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}};

Vec3 random_point(const Bounds3& box, Rng& rng) {
  return box.min + box.extent() * Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
}

double total_intensity(const EmissiveCells& cells) {
  double sum = 0;
  for (std::uint32_t i = 0; i < cells.size(); ++i) sum += cells.intensity(i);
  return sum;
}

double total_power(const EmissiveCells& cells) {
  double sum = 0;
  for (std::uint32_t i = 0; i < cells.size(); ++i) sum += cells.power(i);
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

/// The parallelepiped of a cell, whose corners are found by its density: where it begins to be 0.
class CellFrame {
 public:
  CellFrame(const EmissiveCells& cells, std::uint32_t cell) : to_local_(skewed().inverse()) {
    // A cell is a cube along the medium's axes: from its middle, which its box shares, out to its faces.
    middle_ = to_local_.point(cells.box(cell).center());
    float inside = 0, outside = 1e3f;
    for (int i = 0; i < 60; ++i) {
      const float half = 0.5f * (inside + outside);
      const Vec3 p = skewed().point(middle_ + Vec3{half, 0, 0});
      (cells.pdf(cell, p) > 0 ? inside : outside) = half;
    }
    half_ = inside;
  }
  double volume() const {
    const Transform::Matrix m = skewed().matrix();
    const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return std::abs(det) * std::pow(2.0 * half_, 3);
  }
  std::size_t bin(Vec3 p, int bins) const {
    const Vec3 local = to_local_.point(p) - middle_;
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const float at = (local[axis] / half_ + 1) * 0.5f * static_cast<float>(bins);
      index = index * static_cast<std::size_t>(bins) + static_cast<std::size_t>(std::clamp(static_cast<int>(at), 0, bins - 1));
    }
    return index;
  }
  Vec3 middle(std::size_t bin, int bins) const {
    Vec3 local;
    for (int axis = 0; axis < 3; ++axis, bin /= static_cast<std::size_t>(bins)) {
      const auto at = static_cast<float>(bin % static_cast<std::size_t>(bins)) + 0.5f;
      local[axis] = (2 * at / static_cast<float>(bins) - 1) * half_;
    }
    return skewed().point(middle_ + local);
  }

 private:
  Transform to_local_;
  Vec3 middle_;
  float half_ = 0;
};

}  // namespace

TEST_CASE("emissive cells: what they emit together is what the medium emits") {
  for (const Transform& to_world : {Transform(), skewed()}) {
    const ParticipatingMedium medium = emissive_clumps(to_world);
    const EmissiveCells cells(medium, kAnywhere);
    REQUIRE(cells.size() > 20);
    CHECK(total_intensity(cells) == doctest::Approx(brute_intensity(medium)).epsilon(0.01));
  }
}

TEST_CASE("emissive cells: too many are gathered into larger ones that emit the same") {
  const ParticipatingMedium medium = emissive_clumps(skewed());
  const EmissiveCells fine(medium, kAnywhere), coarse(medium, kAnywhere, 30), one(medium, kAnywhere, 1);
  CHECK(coarse.size() <= 30);
  CHECK(coarse.size() > 1);
  CHECK(one.size() == 1);
  CHECK(total_intensity(coarse) == doctest::Approx(total_intensity(fine)).epsilon(1e-5));
  CHECK(total_intensity(one) == doctest::Approx(total_intensity(fine)).epsilon(1e-5));
}

TEST_CASE("emissive cells: a large box of one value is not taken apart") {
  OracleSource box;
  box.add_tile({0, 0, 0}, {511, 511, 511}, 1);
  const ParticipatingMedium medium = emissive(box, nullptr, 60);
  const Vec3 middle{255.5f, 255.5f, 255.5f};
  for (const std::size_t most : {EmissiveCells::kMost, std::size_t{500}, std::size_t{1}}) {
    const EmissiveCells cells(medium, kAnywhere, most);
    CHECK(cells.size() <= most);
    CHECK(cells.size() >= most / 10);
    CHECK(total_intensity(cells) == doctest::Approx(393.0 * 393 * 393).epsilon(1e-5));
    double emission = 0;  // a volume, but for the tenth that is drawn anywhere
    for (std::uint32_t i = 0; i < cells.size(); ++i) emission += cells.pdf(i, middle) * cells.intensity(i);
    CHECK(emission == doctest::Approx(1).epsilon(0.11));
  }
}

TEST_CASE("emissive cells: a small hot part in a large box of one density") {
  OracleSource box, hot;
  box.add_tile({0, 0, 0}, {511, 511, 511}, 1);
  hot.add_tile({200, 200, 200}, {215, 215, 215}, 3000);
  const ParticipatingMedium medium = emissive(box, &hot);
  const EmissiveCells cells(medium, kAnywhere), few(medium, kAnywhere, 3);
  CHECK(cells.size() >= 8);
  CHECK(cells.size() <= 125);
  CHECK(few.size() <= 3);
  const double inside = mean(medium.data().emission.at({208, 208, 208}));
  CHECK(total_intensity(cells) > 15 * 15 * 15 * inside);
  CHECK(total_intensity(few) == doctest::Approx(total_intensity(cells)).epsilon(1e-5));
}

TEST_CASE("emissive cells: emission at the ends of index space") {
  OracleSource near, both;
  const auto blob = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto inside = [](std::int64_t i) { return (i & 7) >= 2 && (i & 7) <= 5; };
    return inside(x) && inside(y) && inside(z) ? 1.0f : 0.0f;
  };
  const std::int64_t far = 8 * ((std::int64_t{1} << 22) - 1);  // 2^22 bricks a side: 2^66 places
  near.add_leaf({0, 0, 0}, blob);
  both.add_leaf({0, 0, 0}, blob);
  both.add_leaf({far, far, far}, blob);
  const EmissiveCells one(emissive(near), kAnywhere), two(emissive(both), kAnywhere);
  CHECK(one.size() == 8);
  CHECK(total_intensity(one) == doctest::Approx(64).epsilon(1e-3));
  REQUIRE(two.size() == 2);
  CHECK(two.intensity(0) == doctest::Approx(total_intensity(one)));
  CHECK(two.intensity(1) == doctest::Approx(total_intensity(one)));
}

TEST_CASE("emissive cells: none without emission, in a medium without end, or where nothing absorbs") {
  CHECK(EmissiveCells(clumpy(kHot, 3), kAnywhere).empty());
  CHECK(EmissiveCells(homogeneous(kHot, kLe), kAnywhere).empty());
  CHECK(EmissiveCells(homogeneous(kHot), {{{0, 0, 0}, {1, 1, 1}}}).empty());
  CHECK(EmissiveCells(clumpy({.sigma_a = {}, .sigma_s = {1, 1, 1}}, 3, kLe), kAnywhere).empty());
}

TEST_CASE("emissive cells: a thin homogeneous medium fills the box that it lies in") {
  const Bounds3 box{{-1, 2, 0}, {3, 2.5f, 7}};
  const Optics thin{.sigma_a = kHot.sigma_a * 1e-4f, .sigma_s = kHot.sigma_s * 1e-4f};
  const EmissiveCells cells(homogeneous(thin, kLe), {box});
  REQUIRE(cells.size() == 512);
  const double emitted = 4 * 0.5 * 7 * mean(thin.sigma_a * kLe);
  CHECK(total_intensity(cells) == doctest::Approx(emitted).epsilon(1e-5));
  CHECK(total_power(cells) == doctest::Approx(emitted).epsilon(2e-3));
  Bounds3 all;
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    all.expand(cells.box(i));
    CHECK(cells.pdf(i, cells.box(i).center()) == doctest::Approx(512 / 14.0).epsilon(2e-3));
  }
  CHECK(length(all.min - box.min) < 1e-5f);
  CHECK(length(all.max - box.max) < 1e-5f);
}

/// What leaves a cube along its axes of what it emits: (1 - e^-depth) / depth, by channel.
TEST_CASE("emissive cells: what leaves a cube, homogeneous and as a grid, by optical depth") {
  const auto leaving = [](double depth) { return -std::expm1(-depth) / depth; };
  for (const float scale : {1e-2f, 0.3f, 1.2f, 5.0f}) {
    const Bounds3 cube{{0, 0, 0}, {4, 4, 4}};
    const Rgb sigma_a{scale, 2 * scale, 4 * scale};
    const EmissiveCells cells(homogeneous({.sigma_a = sigma_a, .sigma_s = Rgb{scale}}, kLe), {cube});
    double expected = 0;
    for (int k = 0; k < 3; ++k) expected += 64 / 3.0 * double{sigma_a[k] * kLe[k]} * leaving(4.0 * double{sigma_a[k] + scale});
    CHECK(total_power(cells) == doctest::Approx(expected).epsilon(1e-4));
    CHECK(total_intensity(cells) == doctest::Approx(64 * mean(sigma_a * kLe)).epsilon(1e-5));

    const ParticipatingMedium blocks = grid(
        {16, 0, 16}, {.sigma_a = Rgb{scale}, .sigma_s = Rgb{0.5f * scale}}, [](int) { return 1.0f; }, kLe);
    const EmissiveCells voxels(blocks, kAnywhere);
    const double share = total_power(voxels) / total_intensity(voxels);
    CHECK(share == doctest::Approx(leaving(16 * 1.5 * double{scale})).epsilon(0.1));  // voxels at its faces are half within
  }
}

/// A ball, by the chords of lines through it: what is outside emits nothing, and points deep inside are rare.
TEST_CASE("emissive cells: a homogeneous ball, thin and thick") {
  const auto chords = [](const Ray& ray) {
    const float b = dot(ray.o, ray.d), root = b * b - length_squared(ray.o) + 1;
    return root > 0 ? std::vector<Chord>{{-b - std::sqrt(root), -b + std::sqrt(root)}} : std::vector<Chord>{};
  };
  Rng rng(29);
  for (const float sigma : {0.01f, 20.0f}) {
    const EmissiveCells cells(homogeneous({.sigma_a = Rgb{sigma}, .sigma_s = {}}, Rgb{1.0f}),
                              {{{-1, -1, -1}, {1, 1, 1}}, chords});
    CHECK(total_intensity(cells) == doctest::Approx(4 / 3.0 * double{kPi} * double{sigma}).epsilon(0.01));
    CHECK(!cells.at({0.95f, 0.95f, 0.95f}));
    const auto middle = cells.at({0.01f, 0.01f, 0.01f}), skin = cells.at({0.97f, 0.01f, 0.01f});
    REQUIRE((middle && skin));
    const double depth_ratio = cells.power(*middle) / cells.intensity(*middle) / (cells.power(*skin) / cells.intensity(*skin));
    CHECK(depth_ratio > (sigma < 1 ? 0.98 : 0.0));
    CHECK(depth_ratio < (sigma < 1 ? 1.02 : 1e-3));
    if (sigma < 1) continue;
    int outer = 0;
    for (int i = 0; i < 10'000; ++i) {
      const Vec3 p = cells.sample(*skin, {rng.uniform(), rng.uniform(), rng.uniform()});
      outer += p.x > cells.box(*skin).center().x;
    }
    CHECK(outer > 7'500);
  }
}

TEST_CASE("emissive cells: points lie in the cell that they were drawn in, where their density is above 0") {
  const ParticipatingMedium medium = emissive_clumps(skewed());
  Rng rng(3);
  for (const std::size_t most : {EmissiveCells::kMost, std::size_t{30}}) {
    const EmissiveCells cells(medium, kAnywhere, most);
    int elsewhere = 0;
    for (int i = 0; i < 20'000; ++i) {
      const auto cell = static_cast<std::uint32_t>(rng.uniform() * static_cast<float>(cells.size()));
      const Vec3 p = cells.sample(cell, {rng.uniform(), rng.uniform(), rng.uniform()});
      elsewhere += cells.at(p) != cell;
      CHECK(cells.pdf(cell, p) >= 0);
    }
    CHECK(elsewhere < 5);  // rounded across a face
    CHECK(!cells.at({1e6f, 0, 0}));
  }
}

TEST_CASE("emissive cells: points drawn follow their density (chi-squared)") {
  constexpr int kBins = 8, kSamples = 400'000;  // along an edge: half blocks, in which the density is trilinear
  const ParticipatingMedium medium = emissive_clumps(skewed());
  Rng rng(11);
  for (const std::size_t most : {EmissiveCells::kMost, std::size_t{30}}) {
    const EmissiveCells cells(medium, kAnywhere, most);
    const auto cell = static_cast<std::uint32_t>(cells.size() / 2);
    // Where a bin lies is found from the cell's own points: the box of a turned cell holds more than it.
    const CellFrame frame(cells, cell);
    std::vector<int> counts(kBins * kBins * kBins);
    for (int i = 0; i < kSamples; ++i)
      ++counts[frame.bin(cells.sample(cell, {rng.uniform(), rng.uniform(), rng.uniform()}), kBins)];
    double statistic = 0, total = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      // The mean of a trilinear function over a box is its value in the middle.
      const double expected = kSamples * cells.pdf(cell, frame.middle(i, kBins)) * frame.volume() / double(counts.size());
      REQUIRE(expected > 5);
      total += expected;
      statistic += (counts[i] - expected) * (counts[i] - expected) / expected;
    }
    CHECK(total == doctest::Approx(kSamples).epsilon(1e-4));
    const double freedom = double(counts.size()) - 1;
    CHECK((statistic - freedom) / std::sqrt(2 * freedom) < 4);
  }
}

TEST_CASE("emissive cells: where Le is constant nine tenths of a cell's density are its emission, exactly") {
  const ParticipatingMedium medium = emissive_clumps();
  const EmissiveCells cells(medium, kAnywhere);
  Rng rng(17);
  const auto emission = [&](Vec3 p) {
    const Coefficients c = medium.at(p);
    return double{mean(c.sigma_a * c.Le)};
  };
  for (std::uint32_t cell = 0; cell < cells.size(); cell += 7) {
    const Bounds3 box = cells.box(cell);
    const Vec3 farthest = max(box.max, box.min * -1.0f);
    if (std::max({farthest.x, farthest.y, farthest.z}) > 1) continue;  // the medium ends within it
    const Vec3 a = random_point(box, rng);
    double most = 0, off = 0;
    const double peak = cells.intensity(cell) / double{box.extent().x} / double{box.extent().y} / double{box.extent().z};
    for (int i = 0; i < 20; ++i) {
      // Differences, in which what is even falls out.
      const Vec3 b = random_point(box, rng);
      const double drawn = (cells.pdf(cell, a) - cells.pdf(cell, b)) * cells.intensity(cell),
                   wanted = emission(a) - emission(b);
      most = std::max(most, std::abs(wanted));
      off = std::max(off, std::abs(drawn - 0.9 * wanted));
    }
    CHECK(off < 2e-3 * (most + peak));  // nodes and voxels have 16 bits of up to 60 times the mean
  }
}

TEST_CASE("emissive cells: radiance of rays through a block of one emission, thin and thick") {
  for (const float scale : {1e-3f, 0.1f, 3.0f}) {
    const Optics optics{.sigma_a = Rgb{scale}, .sigma_s = Rgb{0.5f * scale}};
    const ParticipatingMedium medium = grid(
        {16, 0, 16}, optics, [](int) { return 1.0f; }, kLe);
    const EmissiveCells cells(medium, kAnywhere);
    const double depth = 1.5 * double{scale} * 16, expected = mean(kLe) / 1.5 * -std::expm1(-depth);
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      CHECK(cells.radiance(i) > 0);
      CHECK(cells.radiance(i) < 1.1 * expected);
    }
    const auto middle = cells.at({8.3f, 8.2f, 8.1f});
    REQUIRE(middle);
    CHECK(cells.radiance(*middle) == doctest::Approx(expected).epsilon(0.06));
  }
}
