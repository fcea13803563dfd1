/// Paths that share the directions in which they left the scene, against paths that do not.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "report/statistics.h"
#include "support/sanitized.h"
#include "support/scratch.h"
#include "support/sharing.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// Open where the camera stands, and by a window of a quarter of the end wall.
std::string open_room() {
  return sharing_sides() + sharing_things() + sharing_wall("0.5 0.5 0.6", "-2 -1.8 2  0 -1.8 2  -2 1.8 2  0 1.8 2") +
         sharing_wall("0.5 0.5 0.6", "0 -1.8 2  2 -1.8 2  0 0 2  2 0 2");
}

/// A map that next-event estimation samples by: dark ground, a bright half of the sky and a small part that is brighter still.
class SkyMap {
 public:
  SkyMap() {
    Image map;
    map.data = map.display = {0, 0, 32, 32};
    for (const char* name : {"R", "G", "B"}) {
      auto& values = map.add_channel(name).values;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 32 < 12 ? 1.0f : 0.2f;
      values[13 * 32 + 18] = 20;
    }
    write_exr(map, path_);
  }
  std::string light(const std::string& more = "") const { return turned("-90 1 0 0", more); }
  /// Its bright half behind the window.
  std::string light_behind() const { return turned("90 0 1 0"); }

 private:
  std::string turned(const std::string& how, const std::string& more = "") const {
    return block("Rotate " + how + "\nLightSource \"infinite\" \"string filename\" \"" + path_ + "\" " + more + "\n");
  }

  Scratch folder_;
  std::string path_ = folder_ / "sky.exr";
};

const Coefficients kSmoke{.sigma_a = {0.02f, 0.05f, 0.1f}, .sigma_s = {1.5f, 1, 0.7f}, .g = 0.3f};

}  // namespace

TEST_CASE("sharing an environment changes the noise alone: a room with a window") {
  check_sharing("one bounce", sharing_camera(1) + open_room() + environment(1), {}, 4);
  check_sharing("four bounces", sharing_camera(4) + open_room() + environment(1), {}, 3);
}

// Each weighs what others have found against its own choice of lights, from where it is.
TEST_CASE("sharing an environment changes the noise alone: maps, beside other lights") {
  const SkyMap sky;
  check_sharing("map", sharing_camera(3) + open_room() + sky.light(), {}, 1.8);
  check_sharing("map and lights",
                sharing_camera(3) + open_room() + sky.light() + environment(0.2f) + point_light({1.2f, -1, 0.6f}, 0.4f), {},
                1.5);
  // Of the window's upper half: who leaves by the lower one, or where the camera stands, has found nothing that others see.
  check_sharing("portal", sharing_camera(2) + open_room() + sky.light("\"point3 portal\" [0 0.9 2  0 1.8 2  2 1.8 2  2 0.9 2]"),
                {}, 1);
}

// What collides receives what others have found from where they collided, and what passes on the surface behind.
TEST_CASE("sharing an environment changes the noise alone: smoke and fog") {
  const SkyMap sky;
  for (const MediaStrategy media : {MediaStrategy::product, MediaStrategy::vertex})
    check_sharing("smoke", sharing_camera(4) + open_room() + environment(1) + sharing_smoke(kSmoke), {.media = media}, 1.7);
  check_sharing("smoke and a map", sharing_camera(4) + open_room() + sky.light() + sharing_smoke(kSmoke), {}, 1.7);
  check_sharing("smoke, one bounce", sharing_camera(1) + open_room() + environment(1) + sharing_smoke(kSmoke), {}, 1.2);
  const std::string fog = homogeneous("f", {.sigma_a = {0.02f, 0.05f, 0.1f}, .sigma_s = {0.3f, 0.15f, 0.2f}, .g = 0.4f}) +
                          medium_box("f", "", {{-3, -3, -5}, {3, 3, 3}});
  check_sharing("fog, one bounce", sharing_camera(1) + open_room() + environment(1) + fog, {}, 1.3);
  check_sharing("fog", sharing_camera(4) + open_room() + environment(1) + fog, {}, 2.7);
  for (const MediaStrategy media : {MediaStrategy::product, MediaStrategy::vertex})
    check_sharing("fog as neighbouring rays see it alike", sharing_camera(4, 16) + open_room() + sky.light() + fog,
                  {.media = media}, 1.7);
  check_sharing("fog whose lights are chosen along rays", sharing_camera(4, 16) + open_room() + sky.light_behind() + fog,
                {.distance = DistanceStrategy::profile}, 1.2);
}

TEST_CASE("sharing an environment changes the noise alone: mirrors and panes") {
  const std::string mirror = block(
      "Material \"conductor\" \"rgb reflectance\" [0.6 0.7 0.8] \"float roughness\" 0\n"
      "Shape \"bilinearmesh\" \"point3 P\" [-1.9 -1 1.9  -0.2 -1 1.4  -1.9 1.4 1.9  -0.2 1.4 1.4]\n");
  const std::string pane = block(
      "Material \"thindielectric\" \"float eta\" 2.2\n"
      "Shape \"bilinearmesh\" \"point3 P\" [-3 -3 -3.2  3 -3 -3.4  -3 3 -3.2  3 3 -3.4]\n");
  check_sharing("mirror", sharing_camera(3) + open_room() + environment(1) + mirror, {}, 2.5);
  check_sharing("pane", sharing_camera(3) + open_room() + environment(1) + pane, {}, 1.1);
}

// Behind fog it is received by paths that have collided before as well. What a bug takes for another kind it takes whole: a
// tenth is close enough.
TEST_CASE("a shared environment is direct light") {
  const std::string fog = homogeneous("f", {.sigma_a = Rgb(0.02f), .sigma_s = Rgb(0.25f), .g = 0.4f}) +
                          medium_box("f", "", {{-3, -3, -5}, {3, 3, 3}});
  const std::vector<std::string> parts{"SurfaceDirect", "SurfaceIndirect", "VolumeDirect", "VolumeIndirect"};
  const int renders = nightly() ? 48 : std::max(2, fewer(16));
  for (const float fov : {62.0f, 12.0f}) {
    CAPTURE(fov);
    const std::string scene = sharing_camera(3, fov) + open_room() + environment(1) + fog;
    std::array<std::array<Moments, 4>, 2> means;
    for (const bool shared : {false, true}) {
      Subject subject(scene, {.reuse = shared ? ReuseStrategy::pixels : ReuseStrategy::off, .budget = BudgetStrategy::fixed});
      for (int i = 0; i < renders; ++i) {
        const Image image = subject.render(8, 100 + 100 * shared + static_cast<std::uint64_t>(i), parts);
        for (std::size_t p = 0; p < parts.size(); ++p) {
          const auto& v = image.find(parts[p] + ".G")->values;
          means[shared][p].add(std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size()));
        }
      }
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
      CAPTURE(parts[p]);
      const Estimate apart = means[0][p].estimate(), shared = means[1][p].estimate();
      const double error = std::hypot(apart.standard_error(), shared.standard_error());
      if (!kSanitized) CHECK(error < 0.1 * apart.mean);
      CHECK(std::abs(apart.mean - shared.mean) < 4.5 * error);
    }
  }
}
