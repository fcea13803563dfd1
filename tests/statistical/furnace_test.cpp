/// Furnaces: where every ray sees the same radiance, nothing in a medium may change it.
#include <doctest/doctest.h>

#include <cmath>

#include "report/block_test.h"
#include "support/agreement.h"
#include "support/scene_text.h"
#include "support/strategies.h"
#include "support/transport_oracles.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};
constexpr Agreement kFurnace{.d = 0.002};

/// Lumps and holes of density 0 .. 1 on 6 x 5 x 4 samples; a quarter of them are empty.
Grid lumpy_grid() {
  Grid grid{kBox, 6, 5, 4, {}};
  for (int i = 0; i < 6 * 5 * 4; ++i) {
    const double v = std::fmod(i * 0.6180339887 + 0.37 * (i % 7), 1.0);
    grid.density.push_back(v < 0.25 ? 0.0f : float(v * v));
  }
  return grid;
}

/// The box from a corner, so that the view holds empty rays, grazing ones and long ones.
View perspective() { return {.eye = {2.2f, 1.8f, -2.6f}, .look = {0, 0, 0}, .fov_degrees = 35, .resolution = 32}; }

/// Three rays through the lumps.
constexpr std::array<Ray, 3> kRays{
    {{{0.2f, 0.1f, -2}, {0, 0, 1}}, {{-2, -0.3f, 0.4f}, {0.96f, 0.28f, 0}}, {{1.5f, 1.5f, 1.5f}, {-0.6f, -0.48f, -0.64f}}}};

std::string looking_along(const Ray& ray) { return view({.eye = ray.o, .look = ray.at(1)}); }

const std::string kEmission =
    "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\nMaterial \"diffuse\" \"rgb reflectance\" [0 0 0]\n";

/// Walls of radiance 1, each triangle a light.
std::string emissive_box() { return block(kEmission + box_mesh({{-4, -5, -6}, {7, 6, 5}})); }

}  // namespace

TEST_CASE("F1: scattering without absorption inside uniform radiance changes no pixel") {
  const std::string scene = view(perspective()) + environment(1) +
                            uniform_grid("m", {.sigma_s = {6, 5, 7}, .g = 0.9f}, lumpy_grid()) + medium_box("m", "", kBox);
  const Measured m = check_agrees("F1 g=0.9, lumpy grid", scene, {1.0, 1.0, 1.0}, kFurnace);
  MeanImage white = m.image;
  for (auto& channel : white.channels) {
    for (Estimate& e : channel) e = {1, 0, 1};
  }
  const auto pixels = block_test(m.image, white);
  const BlockDifference& w = worst(pixels);
  CHECK_MESSAGE(w.welch.p > sidak(1e-3, double(pixels.size())), "pixel ", w.x, ",", w.y, " is off by ", w.welch.difference,
                ", ", w.welch.t, " standard errors");
}

TEST_CASE("F1: a homogeneous medium, backward scattering, a diffuse white plane inside") {
  const std::string scene = view(perspective()) + environment(1) + homogeneous("m", {.sigma_s = {2, 1, 3}, .g = -0.6f}) +
                            medium_box("m", "", kBox) + diffuse_plane(0.1f, 0.5f, 1);
  check_agrees("F1 with a white plane", scene, {1.0, 1.0, 1.0}, kFurnace);
}

TEST_CASE("F1: every phase function scatters all that it takes") {
  for (const std::string& phase : kOtherPhases) {
    const std::string scene = view(perspective()) + environment(1) +
                              uniform_grid("m", {.sigma_s = {6, 5, 7}, .phase = phase}, lumpy_grid()) +
                              medium_box("m", "", kBox);
    check_agrees("F1 with " + phase, scene, {1.0, 1.0, 1.0}, kFurnace);
  }
}

// The MIS weights of scattered rays that hit a light must hold the light's pmf among the others.
TEST_CASE("F1: a white plane in a box of twelve lights, however a light is chosen") {
  const std::string scene =
      view({.eye = {0.1f, 0.2f, 2}, .look = {0.1f, 0.2f, 0}}) + emissive_box() + diffuse_plane(0.1f, 0.5f, 1);
  for (const LightStrategy lights : every_lights()) {
    Agreement how{.d = nightly() ? 0.002 : 0.01};
    how.variant.lights = lights;
    check_agrees("F1 in a box of lights, " + std::string(name_of(lights)), scene, {1.0, 1.0, 1.0}, how);
    if (lights == LightStrategy::exhaustive) continue;
    how.variant.candidates = 4;
    check_agrees("F1 in a box of lights, 4 candidates, " + std::string(name_of(lights)), scene, {1.0, 1.0, 1.0}, how);
  }
}

// A uniform sky is found by scattered rays alone; emissive walls are sampled as lights too, with MIS.
TEST_CASE("F1: inside an emissive box, and an emissive ball") {
  const std::string smoke =
      uniform_grid("m", {.sigma_s = {6, 5.5f, 6.5f}, .g = 0.5f}, lumpy_grid()) + medium_box("m", "", kBox);
  const std::string ball = block(kEmission + "Shape \"sphere\" \"float radius\" 6\n");
  const std::string walls = emissive_box();
  const Agreement how{.d = nightly() ? 0.002 : 0.01};
  check_agrees("F1 in a glowing box", view(perspective()) + walls + smoke, {1.0, 1.0, 1.0}, how);
  check_agrees("F1 in a glowing ball", view(perspective()) + ball + smoke + diffuse_plane(0.1f, 0.5f, 1), {1.0, 1.0, 1.0}, how);
}

// What glass, panes and coats mirror is looked at whether paths go there or not: it must not count twice, nor be missed.
TEST_CASE("F1: glass, panes and white coats, in a furnace of sky or of lights, with smoke before them") {
  const std::string coat =
      "\"rgb reflectance\" [1 1 1] \"float thickness\" 1e-9 \"integer maxdepth\" 1000 \"float roughness\" ";
  const std::string materials[] = {"\"dielectric\"", "\"thindielectric\" \"float eta\" 2.5", "\"coateddiffuse\" " + coat + "0",
                                   "\"coateddiffuse\" \"rgb albedo\" [1 1 1] " + coat + "0"};
  const std::string smoke = homogeneous("m", {.sigma_s = {0.2f, 0.1f, 0.3f}}) + medium_box("m", "", {{-2, -2, -2}, {2, 2, 2}});
  for (const std::string& material : materials) {
    const std::string ball = block("Material " + material + "\nShape \"sphere\" \"float radius\" 1\n");
    const std::string seen = view({.eye = {0.1f, 1.5f, -2.8f}, .look = {0, 0, 0}, .fov_degrees = 40, .max_depth = 200}) + ball;
    const Agreement how{.d = nightly() ? 0.002 : 0.01};
    check_agrees("F1 under a sky, " + material, seen + environment(1), {1.0, 1.0, 1.0}, how);
    check_agrees("F1 in a box of lights, " + material, seen + emissive_box(), {1.0, 1.0, 1.0}, how);
    check_agrees("F1 in smoke under a sky, " + material, seen + smoke + environment(1), {1.0, 1.0, 1.0}, how);
  }
}

TEST_CASE("F2: an absorbing and emitting slab adds 1 - exp(-tau) and lets T through") {
  const Grid grid = lumpy_grid();
  constexpr double kBackground = 0.25;
  for (const Ray& ray : kRays) {
    const double depth = optical_depth(grid, ray, 0, 6);
    CAPTURE(depth);
    REQUIRE(depth > 0.1);
    const Rgb sigma_a{1, 2.5f, 0.4f};
    Expected expected;
    for (int k = 0; k < 3; ++k) {
      const double T = std::exp(-depth * sigma_a[k]);
      expected[k] = 1 - T + T * kBackground;
    }
    check_agrees("F2 tau=" + number(depth),
                 looking_along(ray) + environment(kBackground) +
                     uniform_grid("m", {.sigma_a = sigma_a, .Le = Rgb(1.0f)}, grid) + medium_box("m", "", kBox),
                 expected, kFurnace);
  }
}

TEST_CASE("thermal equilibrium: as hot as its surroundings, a medium is invisible") {
  const Coefficients warm{.sigma_a = {1, 1.5f, 0.7f}, .sigma_s = {3, 2.5f, 3.5f}, .g = 0.9f, .Le = Rgb(1.0f)};
  check_agrees("equilibrium, lumpy grid",
               view(perspective()) + environment(1) + uniform_grid("m", warm, lumpy_grid()) + medium_box("m", "", kBox),
               {1.0, 1.0, 1.0}, kFurnace);
  check_agrees("equilibrium, homogeneous",
               view(perspective()) + environment(1) + homogeneous("m", warm) + medium_box("m", "", kBox), {1.0, 1.0, 1.0},
               kFurnace);
}

TEST_CASE("transmittance of empty, thin and opaque grids") {
  const Grid grid = lumpy_grid();
  const double depth = optical_depth(grid, kRays[0], 0, 6);
  for (const float scale : {0.0f, 1e-3f, 1.0f, 5.0f}) {
    check_agrees(
        "T at sigma_t=" + number(scale),
        looking_along(kRays[0]) + environment(1) + uniform_grid("m", {.sigma_a = Rgb(scale)}, grid) + medium_box("m", "", kBox),
        grey(std::exp(-scale * depth)), {.rounding = rounding_of_voxels(scale * depth)});
  }
  check_vanishes(
      "T at sigma_t=1e4",
      looking_along(kRays[0]) + environment(1) + uniform_grid("m", {.sigma_a = Rgb(1e4f)}, grid) + medium_box("m", "", kBox),
      1e-6);
}
