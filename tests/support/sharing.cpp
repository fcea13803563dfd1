#include "support/sharing.h"

#include <doctest/doctest.h>

#include <cstdio>

#include "report/block_test.h"
#include "report/image_test.h"
#include "support/block_renders.h"
#include "support/sanitized.h"

namespace tyndall::test {
namespace {

constexpr int kResolution = 32;
constexpr int kBlock = 2;  // smaller than what shares, within which light may only have moved
constexpr double kLevel = 1e-3;

std::string ball(const std::string& material, const std::string& at, const std::string& radius) {
  return block("Material " + material + "\nTranslate " + at + "\nShape \"sphere\" \"float radius\" " + radius + "\n");
}

}  // namespace

/// From inside, near the middle of the open side.
std::string sharing_camera(int max_depth, float fov_degrees) {
  return view({.eye = {0.2f, 0.1f, -3.8f},
               .look = {0, -0.3f, 0},
               .fov_degrees = fov_degrees,
               .resolution = kResolution,
               .max_depth = max_depth});
}

std::string sharing_wall(const std::string& rgb, const std::string& corners) {
  return block("Material \"diffuse\" \"rgb reflectance\" [" + rgb + "]\nShape \"bilinearmesh\" \"point3 P\" [" + corners +
               "]\n");
}

std::string sharing_sides() {
  return sharing_wall("0.6 0.6 0.6", "-2 -1.8 -4  2 -1.8 -4  -2 -1.8 2  2 -1.8 2") +  // floor
         sharing_wall("0.7 0.7 0.7", "-2 1.8 -4  2 1.8 -4  -2 1.8 2  2 1.8 2") +
         sharing_wall("0.8 0.1 0.1", "-2 -1.8 -4  -2 -1.8 2  -2 1.8 -4  -2 1.8 2") +
         sharing_wall("0.1 0.7 0.2", "2 -1.8 -4  2 -1.8 2  2 1.8 -4  2 1.8 2");
}

std::string sharing_end(float z) {
  const std::string at = number(z);
  return sharing_wall("0.5 0.5 0.6", "-2 -1.8 " + at + "  2 -1.8 " + at + "  -2 1.8 " + at + "  2 1.8 " + at);
}

/// A block whose edges are seen by some of the pixels of a block only.
std::string sharing_things() {
  return block("Material \"diffuse\" \"rgb reflectance\" [0.7 0.5 0.2]\nTranslate -0.9 -1.1 0.6\nRotate 25 0 1 0\n" +
               box_mesh({{-0.5f, -0.7f, -0.5f}, {0.5f, 0.7f, 0.5f}})) +
         ball("\"conductor\" \"float roughness\" 0.2", "1 -1.3 0.8", "0.5") + ball("\"dielectric\"", "0.1 -1.4 -0.8", "0.35") +
         ball("\"coateddiffuse\"", "1.4 -1.5 -0.9", "0.3") +
         block(
             "Material \"diffusetransmission\"\nShape \"bilinearmesh\" \"point3 P\" [-1.9 -0.4 -1  -1 -0.4 -1.4  -1.9 0.6 "
             "-1  -1 0.6 -1.4]\n");
}

std::string sharing_unlit_room() { return sharing_sides() + sharing_end(2) + sharing_end(-4) + sharing_things(); }

std::string sharing_room() {
  return sharing_unlit_room() + point_light({-1.7f, 1.2f, 1.7f}, 3) + point_light({1.2f, -1.6f, 1.6f}, 0.4f) +
         emitting_square({0.6f, 0.9f, 1.9f}, 0.25f, 9);
}

std::string sharing_soft_room() {
  return sharing_unlit_room() + emitting_square({0.6f, 0.9f, 1.9f}, 0.25f, 9) + emitting_square({-1.2f, 1.2f, 0.5f}, 0.4f, 5);
}

Coefficients sharing_thin_fog() { return {.sigma_a = {0.02f, 0.05f, 0.1f}, .sigma_s = {0.3f, 0.15f, 0.05f}, .g = 0.4f}; }

std::string sharing_smoke(const Coefficients& coefficients) {
  Grid grid{{{-1.5f, -1.7f, -1.5f}, {0.6f, 1, 1.5f}}, 4, 4, 4, {}};
  for (int i = 0; i < 64; ++i) grid.density.push_back(0.1f * float(i % 11));
  return uniform_grid("m", coefficients, grid) + medium_box("m", "", grid.bounds);
}

void check_sharing(const char* name, const std::string& text, Variant variant, double worth, int spp) {
  CAPTURE(name);
  variant.budget = BudgetStrategy::fixed;
  Variant sharing = variant;
  sharing.reuse = ReuseStrategy::pixels;
  const BlockRenders apart = block_renders(Subject(text, variant), kBlock, spp, 1000),
                     shared = block_renders(Subject(text, sharing), kBlock, spp, 2000);
  const auto differences = block_test(shared.blocks, apart.blocks);
  const BlockDifference& w = worst(differences);
  CAPTURE(w.x);
  CAPTURE(w.y);
  CAPTURE(w.channel);
  CAPTURE(w.welch.t);
  CHECK(count_below(differences, sidak(kLevel, static_cast<double>(differences.size()))) == 0);
  const WelchResult mean = mean_test(shared.blocks, apart.blocks, 1);
  const double gain = apart.pixel_variance / shared.pixel_variance;
  std::printf("  %s: mean off by %+.3f %% +- %.3f %%, worst block t %.1f, variance %.2f times less\n", name,
              100 * mean.difference / image_mean(apart.blocks, 1).mean,
              100 * mean.standard_error / image_mean(apart.blocks, 1).mean, w.welch.t, gain);
  CHECK(mean.p > kLevel);
  if (!kSanitized) CHECK(gain > worth);
}

}  // namespace tyndall::test
