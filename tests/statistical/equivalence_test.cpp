/// One picture by several methods: forms of a medium, strategies of choosing lights, estimators of transmittance.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/agreement.h"
#include "support/constant_vdb.h"
#include "support/scene_text.h"
#include "support/strategies.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};
constexpr Coefficients kSmoke{.sigma_a = {0.2f, 0.1f, 0.3f}, .sigma_s = {1.5f, 1.2f, 1}, .g = 0.5f};

/// Long paths cost much and show little that short ones do not.
View camera() {
  return {
      .eye = {1.6f, 1.2f, -3.2f}, .look = {0, -0.1f, 0}, .fov_degrees = 42, .resolution = 32, .max_depth = nightly() ? 12 : 4};
}

std::string lights() {
  return point_light({1.5f, 2, -1.5f}, 6) + emitting_square({-1.2f, 0.8f, 1.4f}, 0.5f, 4) + environment(0.15f);
}

std::string room() { return view(camera()) + lights() + diffuse_plane(1.8f, 4, 0.6f); }

/// Density with holes, 0 .. 1.
Grid wispy_grid() {
  Grid grid{kBox, 9, 8, 7, {}};
  for (int i = 0; i < 9 * 8 * 7; ++i) {
    const int x = i % 9, y = i / 9 % 8, z = i / 72;
    const float r2 = float((x - 4) * (x - 4) + (y - 3) * (y - 3) + (z - 3) * (z - 3));
    grid.density.push_back((x * 7 + y * 5 + z * 3) % 4 == 0 ? 0.0f : std::max(0.0f, 1 - r2 / 20));
  }
  return grid;
}

/// Many lights of all kinds and sizes, in smoke and around it, one behind a wall; nightly twice as many of some.
std::string many_lights() {
  const int step = nightly() ? 1 : 2;
  std::string text = view(camera()) + diffuse_plane(1.8f, 4, 0.6f) + environment(0.05f) + distant_light({1, -1, 2}, 0.3f);
  for (int i = 0; i < 24; i += step) {
    const float a = 0.7f * i;
    text += point_light({1.7f * std::cos(a), -1.4f + 0.13f * i, 1.5f * std::sin(a)}, 0.02f * (1 + i % 5));
  }
  for (int i = 0; i < 6; i += step) text += emitting_square({-1.5f + 0.6f * i, 1.3f, 1.2f}, 0.03f * (1 + i), 3.0f + i);
  text += "LightSource \"spot\" \"point3 from\" [0 2.5 -2] \"point3 to\" [0 0 0] \"float coneangle\" 25 \"rgb I\" [8 6 4]\n";
  text += block(
      "Translate 0.5 -0.9 0.9\nAreaLightSource \"diffuse\" \"rgb L\" [2.5 2 1.5]\nShape \"sphere\" \"float radius\" 0.1\n");
  return text + uniform_grid("m", kSmoke, wispy_grid()) + medium_box("m", "", kBox);
}

}  // namespace

TEST_CASE("constant density: homogeneous, grid of samples, grid of voxels, and two halves") {
  const Grid constant{{{-3, -3, -3}, {3, 3, 3}}, 2, 2, 2, std::vector<float>(8, 1.0f)};  // samples at +-1.5: 1 within
  Coefficients half = kSmoke;
  half.sigma_a = kSmoke.sigma_a * 0.5f;
  half.sigma_s = kSmoke.sigma_s * 0.5f;
  const ConstantVdb file({{-1.3f, -1.3f, -1.3f}, {1.3f, 1.3f, 1.3f}}, 0.1f);
  const std::string box = medium_box("m", "", kBox);
  check_all_agree("constant",
                  {{"homogeneous", room() + homogeneous("m", kSmoke) + box},
                   {"uniformgrid", room() + uniform_grid("m", kSmoke, constant) + box},
                   {"vdb", room() + vdb("m", kSmoke, file.path()) + box},
                   {"two halves", room() + homogeneous("a", half) + uniform_grid("b", half, constant) +
                                      medium_box("a", "", kBox) + medium_box("b", "", kBox)}},
                  {.d = pairwise_precision(4)});
}

TEST_CASE("a wispy grid in one piece and as two overlapping halves with different phase functions") {
  Coefficients half = kSmoke;
  half.sigma_a = kSmoke.sigma_a * 0.5f;
  half.sigma_s = kSmoke.sigma_s * 0.5f;
  check_all_agree("wispy halves",
                  {{"one", room() + uniform_grid("m", kSmoke, wispy_grid()) + medium_box("m", "", kBox)},
                   {"two", room() + uniform_grid("a", half, wispy_grid()) + uniform_grid("b", half, wispy_grid()) +
                               medium_box("a", "", kBox) + medium_box("b", "", kBox)}});
}

TEST_CASE("light strategies") {
  const std::string scene = many_lights();
  std::vector<std::pair<std::string, Variant>> variants;
  auto strategies = every_lights();  // the first two are rendered to the end: the cheapest to know
  std::partition(strategies.begin(), strategies.end(),
                 [](LightStrategy s) { return s == LightStrategy::tree || s == LightStrategy::tree_binary; });
  for (const LightStrategy lights : strategies) {
    Variant variant{.lights = lights};
    if (lights == LightStrategy::uniform || lights == LightStrategy::power) variant.candidates = 8;
    variants.emplace_back(name_of(lights), variant);
  }
  check_all_agree("lights", scene, variants, {.d = pairwise_precision(variants.size())});
}

/// The same with surfaces that favour directions: metal, rough glass and a coat.
std::string glossy_lights() {
  const auto ball = [](const std::string& material, const std::string& place) {
    return block(material + "\nTranslate " + place + "\nShape \"sphere\" \"float radius\" 0.3\n");
  };
  return many_lights() +
         ball("Material \"conductor\" \"rgb reflectance\" [0.8 0.7 0.6] \"bool remaproughness\" false \"float roughness\" 0.15",
              "-1 -1.1 -1") +
         ball("Material \"dielectric\" \"bool remaproughness\" false \"float roughness\" 0.3", "0 -1.3 -1.3") +
         ball("Material \"coateddiffuse\" \"bool remaproughness\" false \"float roughness\" 0.2", "1 -1.1 -1.2");
}

TEST_CASE("splitting, candidates and shadow rays: every pair of settings, and nightly every combination") {
  const std::string scene = glossy_lights();
  constexpr std::array<float, 3> splitting{0, 0.6f, 1};
  constexpr std::array<int, 3> candidates{1, 4, 0}, shadow_rays{1, 0, 2};
  std::vector<std::pair<std::string, Variant>> variants{
      {"default", {}},
      {"plain", {.lights = LightStrategy::tree_binary, .candidates = 1}},
      {"5 by power", {.lights = LightStrategy::power, .candidates = 5, .shadow_rays = 2}}};
  for (std::size_t i = 0; i < 27; ++i) {
    const std::size_t s = i / 9, c = i / 3 % 3, r = i % 3;
    if (!nightly() && (s + c) % 3 != r) continue;  // a Latin square holds every pair once
    const std::string name = "tree, splitting " + std::to_string(splitting[s]).substr(0, 3) + ", " +
                             std::to_string(candidates[c]) + " candidates, " + std::to_string(shadow_rays[r]) + " rays";
    variants.emplace_back(name, Variant{.candidates = candidates[c], .shadow_rays = shadow_rays[r], .splitting = splitting[s]});
  }
  check_all_agree("resampling", scene, variants);
}

// Choices of light know a phase function by its mean cosine; weights and estimates by itself.
TEST_CASE("phase functions, lit along segments, at collisions and by scattered rays") {
  const std::string lights =
      emitting_square({-1.2f, 0.8f, 1.4f}, 0.5f, 4) + environment(0.15f) + point_light({1.5f, 2, -1.5f}, 6);
  for (const std::string& phase : kOtherPhases) {
    const Coefficients smoke{.sigma_a = {0.2f, 0.1f, 0.3f}, .sigma_s = {1.5f, 1.2f, 1}, .phase = phase};
    check_all_agree(
        phase, view(camera()) + lights + diffuse_plane(1.8f, 4, 0.6f) + homogeneous("m", smoke) + medium_box("m", "", kBox),
        {{"default", {}}, {"vertex", {.media = MediaStrategy::vertex}}, {"both", {.distance = DistanceStrategy::both}}});
  }
}

TEST_CASE("transmittance estimators") {
  Coefficients dense = kSmoke;
  dense.sigma_a = kSmoke.sigma_a * 3;
  dense.sigma_s = kSmoke.sigma_s * 3;
  const std::string scene = room() + uniform_grid("m", dense, wispy_grid()) + medium_box("m", "", kBox);
  std::vector<std::pair<std::string, Variant>> variants;
  for (const TransmittanceStrategy t : every_transmittance())
    variants.push_back({std::string(name_of(t)), {.transmittance = t}});
  check_all_agree("transmittance", scene, variants, {.d = pairwise_precision(variants.size())});
}
