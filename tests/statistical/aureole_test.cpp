/// Paths that follow suns through media, against paths that do not.
#include <doctest/doctest.h>

#include <filesystem>

#include "support/agreement.h"
#include "support/scene_text.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

std::string look(int max_depth) {
  return view({.eye = {1.7f, 0.7f, -2.9f}, .look = {0, -0.1f, 0}, .fov_degrees = 36, .resolution = 32, .max_depth = max_depth});
}

/// Below and beside the medium, so that light comes back from where no sun is.
std::string ground() {
  return block(
             "Material \"diffuse\" \"rgb reflectance\" [0.7 0.5 0.3]\nTranslate 0 -1.2 0\nRotate -90 1 0 0\nShape \"disk\" "
             "\"float radius\" 4\n") +
         block(
             "Material \"diffuse\"\nTranslate -0.4 -0.2 0.2\nShape \"sphere\" \"float radius\" "
             "0.4\n");
}

/// A grid of holes and of densities that differ by 20.
Grid billows() {
  Grid grid{kBox, 9, 8, 7, {}};
  for (int i = 0; i < 9 * 8 * 7; ++i) {
    const int x = i % 9, y = i / 9 % 8, z = i / 72;
    grid.density.push_back((x * 7 + y * 5 + z * 3) % 4 == 0 ? 0.0f : 0.05f * float(1 + (x * y + 3 * z) % 20));
  }
  return grid;
}

std::string billowing(const Coefficients& c) { return uniform_grid("m", c, billows()) + medium_box("m", "", kBox); }

void check_guiding(const std::string& name, const std::string& scene, double per_commit = 0.02) {
  Agreement how;
  how.d = nightly() ? 0.003 : per_commit;
  check_all_agree(name, scene,
                  {{"off", {.guiding = GuidingStrategy::off}},
                   {"guided", {.guiding = GuidingStrategy::media}},
                   {"by collisions", {.media = MediaStrategy::vertex, .guiding = GuidingStrategy::media}}},
                  how);
}

}  // namespace

TEST_CASE("following suns changes the noise alone: a cloud of three colours over a ground") {
  check_guiding("cloud", look(20) + ground() + environment(0.2f) + distant_light({1, -2, 1}, 3) +
                             billowing({.sigma_a = {0.01f, 0.2f, 0.5f}, .sigma_s = {12, 9, 5}, .g = 0.85f}));
}

// Two suns, one of which illuminates a part of the medium alone, and an area light in it.
TEST_CASE("following suns changes the noise alone: two suns and an area light") {
  check_guiding("suns", look(12) + ground() + diffuse_plane(1.6f, 0.7f, 0.6f) + distant_light({0, -1, 0.1f}, 2) +
                            distant_light({-1, -0.4f, 1}, 3) + emitting_square({0.2f, 0.3f, -0.5f}, 0.2f, 4) +
                            billowing({.sigma_a = {0.1f, 0.3f, 0.2f}, .sigma_s = {4, 5, 3}, .g = 0.7f}));
}

TEST_CASE("following suns changes the noise alone: media that overlap, with phase functions of every kind") {
  std::string media;
  int i = 0;
  for (const char* phase : {"rayleigh\"", "draine\" \"float g\" 0.6 \"float alpha\" 4", "mie\" \"float diameter\" 2"}) {
    const std::string name = "m" + std::to_string(i);
    const float shift = 0.3f * float(i++);
    media += homogeneous(name, {.sigma_a = {0.05f, 0.02f, 0.1f},
                                .sigma_s = {2, 1.5f, 3},
                                .phase = "\"string phase\" \"" + std::string(phase)}) +
             medium_box(name, "", {{-1 + shift, -1 + shift, -1}, {0.4f + shift, 0.4f + shift, 1 - shift}});
  }
  check_guiding("phases", look(12) + ground() + environment(0.2f) + distant_light({1, -2, 1}, 3) + media);
}

// Where light is scattered back, absorbed soon, and where most of what comes is not the sun's.
TEST_CASE("following suns changes the noise alone: where they are of little use") {
  check_guiding("back", look(8) + ground() + distant_light({1, -2, 1}, 3) +
                            billowing({.sigma_a = {0.1f, 0.2f, 0.5f}, .sigma_s = {6, 4, 5}, .g = -0.6f}));
  check_guiding("soot", look(8) + ground() + distant_light({1, -2, 1}, 3) +
                            billowing({.sigma_a = {6, 4, 5}, .sigma_s = {3, 4, 2}, .g = 0.8f}));
  check_guiding("sky", look(8) + ground() + environment(1) + distant_light({1, -2, 1}, 0.3f) +
                           billowing({.sigma_a = {0.1f, 0.2f, 0.5f}, .sigma_s = {6, 4, 5}, .g = 0.8f}));
}

TEST_CASE("following suns changes the noise alone: a sun in a map") {
  const std::string path = (std::filesystem::temp_directory_path() / "tyndall_aureole_sun.exr").string();
  Image map;
  map.data = map.display = {0, 0, 32, 32};
  for (const char* name : {"R", "G", "B"}) {
    auto& values = map.add_channel(name).values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 32 < 12 ? 1.0f : 0.1f;  // wide lights are found both ways
    values[13 * 32 + 18] = 150;
  }
  write_exr(map, path);
  check_guiding("map",
                look(12) + ground() +
                    block("Rotate -90 1 0 0\nLightSource \"infinite\" \"string filename\" \"" + path + "\"\n") +
                    billowing({.sigma_a = {0.1f, 0.2f, 0.3f}, .sigma_s = {8, 6, 4}, .g = 0.85f}),
                0.01);
  std::filesystem::remove(path);
}
