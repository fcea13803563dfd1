#include "volume/medium.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "support/test_media.h"
#include "tyndall/color.h"
#include "tyndall/error.h"
#include "volume/blackbody_table.h"
#include "volume/cloud_noise.h"
#include "volume/medium_data.h"

using namespace tyndall;

namespace {

const Transform kTransforms[] = {
    Transform(), Transform::translate(3, -2, 10) * Transform::rotate(50, 1, -2, 0.5) * Transform::scale(2, 0.3, -1),
    Transform::scale(-1, -1, -1) * Transform::translate(0.5, 0.25, 0)};

ParticipatingMedium built(const decltype(Medium::kind)& kind, const Transform& to_world, const MediumOptics& optics,
                          std::vector<std::string>* notes = nullptr, MediumBuildOptions options = {}) {
  Medium medium;
  medium.kind = kind;
  medium.to_world = to_world;
  medium.optics = optics;
  medium.name = "test";
  std::vector<std::string> ignored;
  return build_medium(medium, options, notes ? *notes : ignored);
}

/// pbrt's SampledGrid: samples at cell centres, trilinear, zero outside the samples, nothing outside the box.
double sampled_grid(const std::vector<float>& values, const int n[3], const Bounds3& box, Vec3 p) {
  if (!box.contains(p)) return 0;
  int base[3];
  double f[3];
  for (int i = 0; i < 3; ++i) {
    const double x = (double{p[i]} - box.min[i]) / (double{box.max[i]} - box.min[i]) * n[i] - 0.5;
    base[i] = static_cast<int>(std::floor(x));
    f[i] = x - base[i];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    int at[3];
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      at[i] = base[i] + (corner >> i & 1);
      weight *= corner >> i & 1 ? f[i] : 1 - f[i];
      inside = inside && at[i] >= 0 && at[i] < n[i];
    }
    if (inside) sum += weight * values[static_cast<std::size_t>((at[2] * n[1] + at[1]) * n[0] + at[0])];
  }
  return sum;
}

Vec3 random_in(const Bounds3& box, Rng& rng) {
  return box.min + box.extent() * Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
}

}  // namespace

TEST_CASE("uniformgrid reads as pbrt's, whatever the transform") {
  Rng rng(1);
  const int n[3] = {5, 4, 13};
  UniformGridMedium uniform;
  uniform.bounds = {{-1, 0, 2}, {2, 1, 3}};
  uniform.nx = n[0], uniform.ny = n[1], uniform.nz = n[2];
  for (int i = 0; i < n[0] * n[1] * n[2]; ++i) {
    uniform.density.push_back(rng.uniform() < 0.3f ? 0 : rng.uniform());
    uniform.Le_scale.push_back(rng.uniform());
    uniform.temperature.push_back(rng.uniform() * 6 - 1);
  }
  uniform.Le_factor = 0.5f;
  uniform.temperature_scale = 1200;
  uniform.temperature_offset = 0.4f;
  const MediumOptics optics{{1, 2, 3}, {4, 5, 0.5f}, HenyeyGreenstein{0.7f}};
  const Bounds3 wide{{-1.5f, -0.5f, 1.5f}, {2.5f, 1.5f, 3.5f}};
  for (const Transform& to_world : kTransforms) {
    const ParticipatingMedium medium = built(uniform, to_world, optics);
    CHECK(medium.emissive());
    CHECK(medium.scatters());
    CHECK_FALSE(medium.homogeneous());
    CHECK(medium.phase() == Phase(HenyeyGreenstein{0.7f}));
    double worst = 0, worst_Le = 0;
    int outside = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 p = random_in(wide, rng), world = to_world.point(p);
      const Coefficients k = medium.at(world);
      const double d = sampled_grid(uniform.density, n, uniform.bounds, p);
      // Where the transform and back lands on the other side of a face of the box the value jumps.
      bool near_face = false;
      for (int a = 0; a < 3; ++a)
        near_face =
            near_face || std::min(std::abs(p[a] - uniform.bounds.min[a]), std::abs(p[a] - uniform.bounds.max[a])) < 1e-5f;
      if (near_face) continue;
      worst = std::max({worst, std::abs(k.sigma_a.b - 3 * d), std::abs(k.sigma_s.g - 5 * d)});
      if (d > 0) {
        outside += medium.bounds().contains(world) ? 0 : 1;
        const float kelvin = static_cast<float>((sampled_grid(uniform.temperature, n, uniform.bounds, p) - 0.4) * 1200);
        const Rgb expected = kelvin > 100 ? blackbody_rgb(kelvin) *
                                                static_cast<float>(0.5 * sampled_grid(uniform.Le_scale, n, uniform.bounds, p))
                                          : Rgb{};
        worst_Le = std::max(worst_Le, std::abs(double{k.Le.g} - expected.g) / 50);
      }
    }
    CHECK(worst < 5e-4);
    CHECK(worst_Le < 2e-3);
    CHECK(outside == 0);
    CHECK(medium.sigma_maj() >= 7 * 0.99f * (*std::max_element(uniform.density.begin(), uniform.density.end())));
  }
}

TEST_CASE("rgbgrid scales each coefficient by its own grid, and one that is not given is 1 up to the faces") {
  Rng rng(2);
  const int n[3] = {3, 6, 4};
  RgbGridMedium rgb;
  rgb.bounds = {{0, 0, 0}, {1, 2, 1}};
  rgb.nx = n[0], rgb.ny = n[1], rgb.nz = n[2];
  rgb.scale = 3;
  std::vector<float> red;
  for (int i = 0; i < n[0] * n[1] * n[2]; ++i) {
    rgb.sigma_s.push_back({rng.uniform(), rng.uniform(), rng.uniform()});
    rgb.Le.push_back({rng.uniform(), 0, 1});
    red.push_back(rgb.sigma_s.back().r);
  }
  const ParticipatingMedium medium = built(rgb, kTransforms[1], {});
  CHECK(medium.emissive());
  double worst = 0, worst_a = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = random_in({{0.001f, 0.001f, 0.001f}, {0.999f, 1.999f, 0.999f}}, rng);
    const Coefficients k = medium.at(kTransforms[1].point(p));
    worst = std::max(worst, std::abs(k.sigma_s.r - 3 * sampled_grid(red, n, rgb.bounds, p)));
    worst_a = std::max(worst_a, std::abs(k.sigma_a.g - 3.0));
  }
  CHECK(worst < 2e-4);
  CHECK(worst_a == 0);
  CHECK(is_black(medium.at(kTransforms[1].point({0.5f, 2.01f, 0.5f})).sigma_t()));
  CHECK(is_black(medium.at(kTransforms[1].point({-0.01f, 1, 0.5f})).sigma_t()));
}

TEST_CASE("grids of impossible sizes and values are errors that say so") {
  UniformGridMedium uniform;
  uniform.nx = uniform.ny = uniform.nz = 2;
  uniform.density = {1, 2, 3};
  CHECK_THROWS_WITH_AS(built(uniform, {}, {}), "medium \"test\": has 3 values of density; nx*ny*nz is 8", Error);
  uniform.density.assign(8, 1.0f);
  uniform.density[3] = std::nanf("");
  CHECK_THROWS_AS(built(uniform, {}, {}), Error);
  CHECK(built(uniform, {}, {}, nullptr, {.sanitize = true}).sigma_maj() > 0);
  uniform.density[3] = -1;
  std::vector<std::string> notes;
  built(uniform, {}, {}, &notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("negative") != std::string::npos);
  uniform.bounds = {{0, 0, 0}, {1, 0, 1}};
  CHECK_THROWS_AS(built(uniform, {}, {}), Error);
}

TEST_CASE("a colour of emission beside temperatures is ignored with a warning") {
  UniformGridMedium grid;
  grid.density = {1};
  grid.temperature = {1000};
  std::vector<std::string> notes;
  built(grid, Transform(), {}, &notes);
  CHECK(notes.empty());
  grid.Le = Rgb(2);
  built(grid, Transform(), {}, &notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "warning: medium \"test\": Le is ignored beside temperatures; leave out either, or use Lescale");
}

TEST_CASE("a homogeneous medium is everywhere and emits only what it absorbs") {
  const ParticipatingMedium fog =
      built(HomogeneousMedium{{1, 2, 3}}, {}, {{0.1f, 0.2f, 0.3f}, {1, 1, 1}, HenyeyGreenstein{0.2f}});
  CHECK(fog.homogeneous());
  CHECK(fog.emissive());
  CHECK(fog.at({1e6f, 0, 0}).Le == Rgb{1, 2, 3});
  CHECK(fog.bounds().contains({-1e30f, 1e30f, 0}));
  CHECK_FALSE(built(HomogeneousMedium{{1, 2, 3}}, {}, {{0, 0, 0}, {1, 1, 1}, {}}).emissive());
  CHECK_FALSE(built(HomogeneousMedium{}, {}, {{1, 1, 1}, {0, 0, 0}, {}}).scatters());
}

TEST_CASE("cloud: density in [0,1], only inside its box") {
  CloudMedium cloud;
  cloud.bounds = {{-1, -1, -1}, {1, 1, 1}};
  const ParticipatingMedium medium = built(cloud, kTransforms[1], {Rgb{1.0f}, Rgb{2.0f}, {}});
  Rng rng(4);
  double sum = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random_in({{-1.2f, -1.2f, -1.2f}, {1.2f, 1.2f, 1.2f}}, rng);
    const Coefficients k = medium.at(kTransforms[1].point(p));
    const bool inside = cloud.bounds.contains(p);
    sum += k.sigma_a.r;
    CHECK(k.sigma_a.r >= 0);
    CHECK(k.sigma_a.r <= 1);
    if (inside && p.y < -0.1f) CHECK(k.sigma_s.r == 2);
    if (!inside && length(p) > 1.8f) CHECK(k.sigma_s.r == 0);
  }
  CHECK(sum > 0);
}

TEST_CASE("the black-body table errs by less than 1e-4 of the largest channel") {
  const BlackbodyTable table;
  double worst = 0;
  for (float kelvin = 300; kelvin < 30000; kelvin *= 1.0007f) {
    const Rgb exact = blackbody_rgb(kelvin), got = table(kelvin);
    const float top = max_component(exact);
    if (top < 1e-30f) continue;
    worst = std::max({worst, std::abs(double{exact.r} - got.r) / top, std::abs(double{exact.g} - got.g) / top,
                      std::abs(double{exact.b} - got.b) / top});
  }
  CHECK(worst < 1e-4);
  CHECK(is_black(table(100)));
  CHECK(is_black(table(-5)));
  CHECK(is_black(table(std::nanf(""))));
}
