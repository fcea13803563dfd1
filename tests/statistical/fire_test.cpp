/// Volume emission as lights: one picture whether scattered rays alone find it or next-event estimation samples it, at every
/// vertex or at the first.
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "support/agreement.h"
#include "support/scene_text.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kHearth{{-0.5f, -0.9f, -0.4f}, {0.4f, 0.1f, 0.5f}};
constexpr Bounds3 kRoom{{-1, -1, -1}, {1, 1, 1}};
constexpr Coefficients kFire{.sigma_a = {2, 2.5f, 3}, .sigma_s = {1, 1, 1}, .g = 0.3f, .Le = {8, 4, 1}};

/// Flames with holes over `box`, of several bricks.
Grid flames(const Bounds3& box) {
  Grid grid{box, 20, 22, 18, {}};
  for (int i = 0; i < 20 * 22 * 18; ++i) {
    const int x = i % 20, y = i / 20 % 22, z = i / 440;
    const float v = std::sin(0.9f * x) * std::cos(0.7f * z) + std::sin(0.5f * y + 0.3f * x);
    grid.density.push_back(v > 0 ? v * (1.2f - 0.04f * y) : 0.0f);
  }
  return grid;
}

std::string emissive_grid(const Bounds3& box = kHearth) {
  return uniform_grid("fire", kFire, flames(box)) + medium_box("fire", "", box);
}

std::string smoke(const Coefficients& c) { return homogeneous("smoke", c) + medium_box("smoke", "", kRoom); }

View camera(int depth = 6) {
  return {.eye = {0.9f, 0.7f, -2.6f}, .look = {0, -0.1f, 0.2f}, .fov_degrees = 45, .resolution = 32, .max_depth = depth};
}

std::string walls() {
  const std::string grey = "Material \"diffuse\" \"rgb reflectance\" [0.6 0.5 0.4]\n";
  return diffuse_plane(0.8f, 2, 0.6f) + block(grey +
                                              "Shape \"trianglemesh\" \"point3 P\" [-2 -1.02 -2 2 -1.02 -2 2 -1.02 2 -2 -1.02 "
                                              "2] \"integer indices\" [0 1 2 0 2 3]\n");
}

constexpr Variant kPaths{.emission = EmissionStrategy::paths}, kAuto{.emission = EmissionStrategy::automatic};

/// Volume emission sampled as lights.
Variant sampled(Variant variant = {}) {
  variant.emission = EmissionStrategy::lights;
  return variant;
}

/// 1 % is too much for a commit, since `paths` finds small emissive volumes by chance. Nightly the scenes are held at the
/// precision of the night; the defects met while this was written were of 6 to 9 %.
Agreement at(double per_commit) {
  Agreement how;
  if (!nightly()) how.d = per_commit;
  return how;
}

/// A scene of volumes/mantaflow_smoke, small; paths in it are those of the repository.
std::string mantaflow(const std::string& name) {
  const std::string folder = "volumes/mantaflow_smoke/";
  std::ifstream file(TYNDALL_SOURCE_DIR "/" + folder + name + ".pbrt");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto put = [&](const std::string& old, const std::string& now) {
    const auto at = text.find(old);
    REQUIRE(at != std::string::npos);
    text.replace(at, old.size(), now);
  };
  put("\"integer xresolution\" 640 \"integer yresolution\" 640", "\"integer xresolution\" 32 \"integer yresolution\" 32");
  put("\"mantaflow_smoke_0050.vdb\"", "\"" + folder + "mantaflow_smoke_0050.vdb\"");
  return text;
}

}  // namespace

/// Of three that must agree at d, each is held against the mean of the others at 3/4 of it.
TEST_CASE("paths, auto and lights are one picture: a flame in a hall, a flame and hot smoke from a file") {
  const auto check = [](const std::string& name, const std::string& scene) {
    check_all_agree(name, scene, {{"paths", kPaths}, {"lights", sampled()}, {"auto", kAuto}},
                    {.d = nightly() ? pairwise_precision(3) : 0.03});
  };
  check("settings, hall", view(camera(9)) + walls() + emissive_grid());
  check("settings, dark room", mantaflow("dark_room"));
  check("settings, hot smoke", mantaflow("mantaflow_smoke"));
}

TEST_CASE("volume emission lights a diffuse room, however a brick is chosen") {
  const std::string scene = view(camera()) + walls() + emissive_grid() + point_light({-0.8f, 0.9f, -0.9f}, 0.3f);
  check_all_agree("fire in a room", scene,
                  {{"paths", kPaths},
                   {"auto", kAuto},
                   {"tree", sampled()},
                   {"tree-binary", sampled({.lights = LightStrategy::tree_binary})},
                   {"power, 3 to 1", sampled({.lights = LightStrategy::power, .candidates = 3})},
                   {"uniform", sampled({.lights = LightStrategy::uniform})},
                   {"4 split, all traced", sampled({.candidates = 4, .shadow_rays = 0, .splitting = 0.8f})}},
                  at(0.03));
  if (!nightly()) return;
  // Every brick at every vertex: at 0.3 % more than half an hour of a core and not done.
  check_same("every brick of a fire in a room",
             {{"exhaustive", scene, sampled({.lights = LightStrategy::exhaustive})},
              {"exhaustive paths", scene, {.lights = LightStrategy::exhaustive, .emission = EmissionStrategy::paths}},
              {"paths", scene, kPaths}},
             {.d = 0.01});
}

TEST_CASE("volume emission in smoke that scatters, by every strategy along segments") {
  const std::string scene = view(camera(4)) + walls() + emissive_grid() +
                            smoke({.sigma_a = {0.1f, 0.1f, 0.1f}, .sigma_s = {0.5f, 0.6f, 0.7f}, .g = 0.2f});
  check_all_agree(
      "fire in smoke", scene,
      {{"paths", kPaths},
       {"auto", kAuto},
       {"vertex", sampled({.media = MediaStrategy::vertex})},
       {"product", sampled()},
       {"product, 4 to 2", sampled({.candidates = 4, .shadow_rays = 2})},
       {"integral, both", sampled({.media = MediaStrategy::integral, .distance = DistanceStrategy::both})},
       {"closest, tracking", sampled({.media = MediaStrategy::closest, .distance = DistanceStrategy::tracking})},
       {"equiangular, by power", sampled({.lights = LightStrategy::power, .distance = DistanceStrategy::equiangular})}},
      at(0.03));
}

TEST_CASE("volume emission in smoke that scatters forward, g = 0.9") {
  const std::string scene = view(camera(5)) + emissive_grid() + smoke({.sigma_s = {1.2f, 1, 1.4f}, .g = 0.9f});
  check_all_agree(
      "fire in forward smoke", scene,
      {{"paths", kPaths}, {"auto", kAuto}, {"vertex", sampled({.media = MediaStrategy::vertex})}, {"product", sampled()}},
      at(0.03));
}

TEST_CASE("the camera in an emissive medium, and a wall in it") {
  View inside = camera();
  inside.eye = {0, -0.4f, 0};
  inside.look = {0.3f, -0.5f, 1};
  inside.fov_degrees = 80;
  const std::string wall =
      block("Material \"diffuse\" \"rgb reflectance\" [0.7 0.7 0.7]\nShape \"disk\" \"float radius\" 0.3\n");
  const std::string scene =
      view(inside) + walls() + emissive_grid() + block("Translate 0.1 -0.4 0.2\nRotate 40 1 1 0\n" + wall);
  check_all_agree(
      "within fire", scene,
      {{"paths", kPaths}, {"auto", kAuto}, {"product", sampled()}, {"vertex", sampled({.media = MediaStrategy::vertex})}},
      at(0.03));
}

TEST_CASE("bricks beyond the boundary of their medium, a group for each half, volume emission in an unbounded fog") {
  const Grid grid = flames(kHearth);
  const Bounds3 left{kHearth.min, {-0.1f, 0.05f, 0.3f}}, right{{0.1f, -0.9f, -0.4f}, kHearth.max};
  const std::string scene = view(camera()) + walls() + uniform_grid("fire", kFire, grid) + medium_box("fire", "", left) +
                            medium_box("fire", "", right);
  check_all_agree(
      "halves of fire", scene,
      {{"paths", kPaths}, {"auto", kAuto}, {"product", sampled()}, {"vertex", sampled({.media = MediaStrategy::vertex})}},
      at(0.03));

  View foggy = camera(4);
  foggy.before_camera = homogeneous("fog", {.sigma_s = {0.1f, 0.1f, 0.1f}, .Le = {}});
  foggy.medium = "fog";
  const std::string fog = view(foggy) + walls() + emissive_grid();
  check_all_agree("fire in fog", fog, {{"paths", kPaths}, {"auto", kAuto}, {"product", sampled()}}, at(0.03));
}

TEST_CASE("thermal equilibrium with a white wall, volume emission sampled as lights") {
  const Coefficients warm{.sigma_a = {1, 2, 0.5f}, .sigma_s = {3, 2, 4}, .g = 0.5f, .Le = Rgb(1.0f)};
  const std::string scene = view(camera(1000)) + environment(1) + uniform_grid("m", warm, flames(kHearth)) +
                            medium_box("m", "", kHearth) + diffuse_plane(0.6f, 0.7f, 1);
  const Agreement furnace{.d = nightly() ? 0.004 : 0.012, .variant = sampled()};
  check_agrees("equilibrium by spans", scene, {1.0, 1.0, 1.0}, furnace);
  Agreement vertex = furnace;
  vertex.variant.media = MediaStrategy::vertex;
  check_agrees("equilibrium by vertices", scene, {1.0, 1.0, 1.0}, vertex);
  Agreement first = furnace;
  first.variant = kAuto;
  check_agrees("equilibrium by first vertices", scene, {1.0, 1.0, 1.0}, first);
}

/// E = pi Le (R / d)^2 b in front of the sphere's centre, b = 1 - 2 (1 - (1 + tau) e^-tau) / tau^2, tau = 2 sigma_a R: the flux
/// of a black disk, less what is not absorbed.
TEST_CASE("irradiance of a sphere that emits and absorbs, thin and thick, in closed form") {
  constexpr double kFacing = 0.5 * 0.5 / (0.8 * 0.8), kReflectance = 0.5;
  const View oblique{.eye = {3, 0, -1}, .look = {0, 0, 0.8f}, .max_depth = 4};
  const auto scene = [&](Rgb tau) {
    return view(oblique) + diffuse_plane(0.8f, 2, static_cast<float>(kReflectance)) +
           homogeneous("m", {.sigma_a = tau, .Le = Rgb(1.0f)}) +
           block("Material \"interface\"\nMediumInterface \"m\" \"\"\nShape \"sphere\" \"float radius\" 0.5\n");
  };
  const auto expected = [&](std::array<double, 3> b) {
    Expected e;
    for (std::size_t i = 0; i < 3; ++i) e[i] = kReflectance * kFacing * b[i];
    return e;
  };
  struct Case {
    Rgb tau;
    std::array<double, 3> b;
  };
  for (const auto& [tau, b] : {Case{{0.01f, 0.1f, 0.5f}, {0.00664173, 0.06423197, 0.27836792}},
                               Case{{1, 5, 20}, {0.47151776, 0.92323421, 0.99500000}}}) {
    for (const auto& [name, variant] : {std::pair{"auto", kAuto}, std::pair{"paths", kPaths}, std::pair{"lights", sampled()}})
      check_agrees("sphere of optical depth " + number(tau.r) + ", " + name, scene(tau), expected(b), {.variant = variant});
  }
}
