/// Grids at the ends of what numbers hold: nothing in them, one voxel, indices of hundreds of millions, densities next to
/// zero and next to infinity, and rays in the very planes between cells. Absorption alone tells, in closed form.
#include <doctest/doctest.h>

#include <cmath>

#include "support/agreement.h"
#include "support/scene_text.h"
#include "support/scratch.h"
#include "support/transport_oracles.h"
#include "support/vdb_writer.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};
constexpr float kExact = 1e-30f;  ///< half a window in which coordinates do not change

std::string along(Vec3 eye, Vec3 look, float half_width = kExact) {
  return view({.eye = eye, .look = look, .half_width = half_width, .resolution = 8}) + environment(1);
}

/// A ray from outside the box straight on into it: where it passes the middle.
Vec3 middle_of(Vec3 from) {
  Vec3 to = from;
  for (int i = 0; i < 3; ++i) to[i] = std::abs(from[i]) > 2 ? 0 : from[i];
  return to;
}

void check_depth(const std::string& name, const std::string& scene, double tau) {
  check_agrees(
      name, scene, grey(std::exp(-tau)),
      {.d = nightly() ? 0.003 : 0.02, .rounding = rounding_of_voxels(tau), .variant = {.emission = EmissionStrategy::lights}});
}

Grid lumps() {
  Grid grid{kBox, 4, 4, 4, {}};
  for (int i = 0; i < 64; ++i) grid.density.push_back(i % 5 == 0 ? 0.0f : 0.25f * float(i * 7 % 11));
  return grid;
}

/// 8^3 voxels of side 1/8 whose first has index (at, at, at), centred on the origin. Other sizes would not do: OpenVDB takes
/// them from a matrix as a difference of translations, and 0.1 is a voxel in 10^8 off then.
VdbGrid block_of_voxels(int at, float density) {
  const double middle = at + 3.5;
  return {.index_to_world = Transform::scale(0.125, 0.125, 0.125) * Transform::translate(-middle, -middle, -middle),
          .boxes = {{{at, at, at}, {at + 7, at + 7, at + 7}, density}}};
}

}  // namespace

TEST_CASE("grids without a voxel let everything through") {
  const Scratch folder;
  const std::string path = folder / "empty.vdb";
  write_vdb(path, {VdbGrid{}});
  const Coefficients smoke{.sigma_a = Rgb(2.0f), .sigma_s = Rgb(3.0f), .g = 0.9f, .Le = Rgb(1.0f)};
  const std::string box = medium_box("m", "", kBox);
  const std::string grid = uniform_grid("m", smoke, {kBox, 3, 2, 4, std::vector<float>(24)});
  check_depth("grid of zeros", along({0, 0, -3}, {0, 0, 0}) + grid + box, 0);
  check_depth("grid of zeros, from within", along({0, 0, 0}, {1, 2, 3}) + grid + box, 0);
  const std::string none = vdb("m", smoke, path);
  check_depth("no voxel", along({0, 0, -3}, {0, 0, 0}) + none + box, 0);
  check_depth("no voxel, from within", along({0, 0, 0}, {1, 2, 3}) + none + box, 0);
}

TEST_CASE("one voxel") {
  const Scratch folder;
  const std::string path = folder / "one.vdb";
  write_vdb(path, {VdbGrid{.index_to_world = Transform::scale(0.5, 0.5, 0.5), .voxels = {{{0, 0, 0}, 1}}}});
  const Grid grid{kBox, 1, 1, 1, {1}};
  constexpr double kSigma = 2;  // at 3 the darkest of these would take more than 2^20 samples a pixel for 0.3 %
  const Coefficients smoke{.sigma_a = Rgb(float(kSigma))};
  const std::string box = medium_box("m", "", kBox);
  for (const Vec3 from : {Vec3{0, 0, -3}, Vec3{-3, 0.25f, 0.125f}, Vec3{0.125f, 3, -0.375f}}) {
    const Vec3 to = middle_of(from);
    double tent = 0.5;
    for (int i = 0; i < 3; ++i) tent *= 1 - 2 * std::abs(to[i]);
    check_depth("one voxel of a file", along(from, to) + vdb("m", smoke, path) + box, kSigma * tent);
    check_depth("one cell", along(from, to) + uniform_grid("m", smoke, grid) + box,
                kSigma * optical_depth(grid, {from, normalize(to - from)}, 0, 6));
  }
}

TEST_CASE("indices of hundreds of millions") {
  const Scratch folder;
  const std::string path = folder / "far.vdb";
  for (const int at : {0, 1 << 28, -(1 << 28), 2'147'000'000, -2'147'000'000}) {
    write_vdb(path, {block_of_voxels(at, 1)});
    const std::string scene = vdb("m", {.sigma_a = Rgb(2.0f)}, path) + medium_box("m", "", kBox);
    const std::string name = "voxels from " + std::to_string(at);
    check_depth(name, along({0.13f, 0.07f, -3}, {0.13f, 0.07f, 0}) + scene, 2);
    check_depth(name + ", along x", along({3, -0.06f, 0.2f}, {0, -0.06f, 0.2f}) + scene, 2);
  }
}

TEST_CASE("densities from subnormal to the largest: what counts is their product with sigma") {
  const Scratch folder;
  const std::string path = folder / "extreme.vdb";
  for (const float density : {1e-30f, 1e30f}) {
    const auto sigma = float(1.5 / double{density});
    const std::string name = "density " + number(density);
    const Coefficients smoke{.sigma_a = Rgb(sigma)};
    const Grid grid{kBox, 2, 2, 2, std::vector<float>(8, density)};
    const Grid unit{kBox, 2, 2, 2, std::vector<float>(8, 1)};
    const Ray ray{{0.13f, 0.07f, -3}, {0, 0, 1}};
    check_depth(name, along(ray.o, ray.at(1)) + uniform_grid("m", smoke, grid) + medium_box("m", "", kBox),
                double{sigma} * density * optical_depth(unit, ray, 0, 6));
    write_vdb(path, {block_of_voxels(0, density)});
    check_depth(name + ", of a file", along(ray.o, ray.at(1)) + vdb("m", smoke, path) + medium_box("m", "", kBox),
                double{sigma} * density);
  }
  // Beyond, the two numbers are refused: they would come to nothing.
  for (const float density : {6e-39f, 1e-34f, 3.4e38f}) {
    const Coefficients smoke{.sigma_a = Rgb(float(1.5 / double{density}))};
    const std::string scene =
        along({0, 0, -3}, {0, 0, 0}) + uniform_grid("m", smoke, {kBox, 1, 1, 1, {density}}) + medium_box("m", "", kBox);
    CHECK_THROWS_WITH_AS(Subject{scene}, doctest::Contains("bring both nearer to 1"), Error);
  }
  check_depth("density 1e-42, sigma 1",
              along({0.13f, 0.07f, -3}, {0.13f, 0.07f, 0}) +
                  uniform_grid("m", {.sigma_a = Rgb(1.0f)}, {kBox, 2, 2, 2, std::vector<float>(8, 1e-42f)}) +
                  medium_box("m", "", kBox),
              0);
}

// Voxels are held in 65,535 steps of their brick's largest: 1 is one of them here.
TEST_CASE("one voxel 4,096 times as dense as the others, and nightly 65,535 times") {
  const float dense = nightly() ? 65535.0f : 65535.0f / 16;
  Grid grid{kBox, 8, 8, 8, std::vector<float>(512, 1)};
  grid.density[(4 * 8 + 4) * 8 + 4] = dense;
  const std::string smoke = uniform_grid("m", {.sigma_a = Rgb(1.0f)}, grid) + medium_box("m", "", kBox);
  for (const Vec3 from : {Vec3{0.4f, 0.13f, -3}, Vec3{-3, -0.2f, 0.13f}, Vec3{0.13f, 3, 0.45f}}) {
    const Vec3 to = middle_of(from);
    check_agrees("beside the dense voxel", along(from, to) + smoke,
                 grey(std::exp(-optical_depth(grid, {from, normalize(to - from)}, 0, 6))), {.d = 0.05});
  }
  check_vanishes("through the dense voxel", along({0.13f, 0.13f, -3}, {0.13f, 0.13f, 0}) + smoke, 1e-6);
}

TEST_CASE("rays in the planes between cells, along their edges and through their corners") {
  const Grid grid = lumps();
  const std::string scene = uniform_grid("m", {.sigma_a = Rgb(0.7f)}, grid) + medium_box("m", "", kBox);
  constexpr std::array<Vec3, 9> kDirections{
      {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, -1, 1}, {1, 1, 1}, {-1, 1, -1}}};
  for (const Vec3 through :
       {Vec3{0, 0, 0}, Vec3{0.5f, 0, 0}, Vec3{0.5f, -0.5f, 0.5f}, Vec3{0.25f, 0.25f, 0.25f}, Vec3{0, 0.25f, -0.5f}}) {
    for (const Vec3 d : kDirections) {
      const Vec3 eye = through - d * 4;
      check_depth("through " + number(through.x) + " " + number(through.y) + " " + number(through.z) + " along " + number(d.x) +
                      " " + number(d.y) + " " + number(d.z),
                  along(eye, through) + scene, 0.7 * optical_depth(grid, {eye, normalize(d)}, 0, 12));
    }
  }
}

// In the face of a box a ray is neither within nor without; what it finds is one of the two, and no fault.
TEST_CASE("rays in the faces and along the edges of a box of smoke") {
  constexpr double kTau = 1;
  for (const Vec3 eye : {Vec3{1, 0.3f, -3}, Vec3{1, 1, -3}, Vec3{-1, -1, -3}, Vec3{0.3f, -1, -3}}) {
    for (const bool grid : {false, true}) {
      const Coefficients smoke{.sigma_a = Rgb(float(kTau) / 2)};
      const std::string medium =
          grid ? uniform_grid("m", smoke, {kBox, 2, 2, 2, std::vector<float>(8, 1)}) : homogeneous("m", smoke);
      Subject subject(along(eye, eye + Vec3{0, 0, 1}) + medium + medium_box("m", "", kBox));
      const Image image = subject.render(16, 1);
      CHECK_MESSAGE(subject.faults().empty(), subject.faults());
      for (const float v : image.find("R")->values) {
        const bool inside_or_out = v >= std::exp(-kTau) * 0.9999 && v <= 1;
        CHECK(inside_or_out);
      }
    }
  }
}
