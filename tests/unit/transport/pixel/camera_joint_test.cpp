/// Where film positions are drawn around point lights: single scattering has other pixels with it than without.
#include <doctest/doctest.h>

#include "support/sphere_scene.h"

namespace tyndall {
namespace {

struct Fog {
  std::string camera = "\"perspective\" \"float fov\" 40";
  float sigma = 1;
  float distance = 4;                  ///< of a ball of it from the camera
  std::string light = "0.1 0.2 -0.3";  ///< seen from the ball's center
  std::string filter = "\"gaussian\"";
};

World world_of(const Fog& fog) {
  const std::string at = std::to_string(fog.distance), s = std::to_string(fog.sigma);
  const std::string text =
      "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 12\n"
      "PixelFilter " +
      fog.filter + "\nCamera " + fog.camera +
      "\nWorldBegin\n"
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0 0 0] \"rgb sigma_s\" [" +
      s + " " + s + " " + s + "]\nTranslate 0 0 " + at +
      "\n"
      "LightSource \"point\" \"point3 from\" [" +
      fog.light +
      "]\n"
      "LightSource \"point\" \"point3 from\" [9 9 9]\n"
      "MediumInterface \"fog\" \"\"\nMaterial \"interface\"\nShape \"sphere\" \"float radius\" 1\n";
  return test::world_of(text, {.threads = 1});
}

Image picture(const World& world, JointStrategy joint, std::optional<PixelBounds> crop = {}) {
  RenderSettings settings;
  settings.spp = 2;
  settings.threads = 1;
  settings.max_depth = 1;
  settings.joint = joint;
  settings.crop = crop;
  return render(world, settings).image;
}

bool draws_around_lights(const Fog& fog) {
  const World world = world_of(fog);
  const Image with = picture(world, JointStrategy::points), without = picture(world, JointStrategy::off);
  return with.find("R")->values != without.find("R")->values;
}

TEST_CASE("film positions are drawn around point lights that fog shows, near and far, by any narrow filter") {
  CHECK(draws_around_lights({}));
  CHECK(draws_around_lights({.camera = "\"perspective\" \"float fov\" 4", .sigma = 4, .distance = 40}));
  CHECK(draws_around_lights({.filter = "\"box\""}));
  CHECK(draws_around_lights({.filter = "\"mitchell\""}));
  CHECK_FALSE(draws_around_lights({.filter = "\"box\" \"float xradius\" 1e5 \"float yradius\" 1e5"}));
}

TEST_CASE(
    "they are not around point lights out of fog, deep in it or behind the camera, nor through a lens or by parallel rays") {
  CHECK_FALSE(draws_around_lights({.light = "0 1.5 0"}));
  CHECK_FALSE(draws_around_lights({.sigma = 40}));
  CHECK_FALSE(draws_around_lights({.distance = 0.1f, .light = "0 0 -0.5"}));
  CHECK_FALSE(
      draws_around_lights({.camera = "\"perspective\" \"float fov\" 40 \"float lensradius\" 0.1 \"float focaldistance\" 4"}));
  CHECK_FALSE(draws_around_lights({.camera = "\"orthographic\""}));
}

TEST_CASE("a crop has the pixels of the whole picture, with a light's image on its rim") {
  const World world = world_of({});
  const Image whole = picture(world, JointStrategy::points);
  for (const PixelBounds crop : {PixelBounds{0, 0, 8, 12}, PixelBounds{8, 5, 16, 12}, PixelBounds{9, 6, 10, 7}}) {
    const Image part = picture(world, JointStrategy::points, crop);
    bool same = true;
    for (int y = crop.y0; y < crop.y1; ++y) {
      for (int x = crop.x0; x < crop.x1; ++x) {
        const auto at = static_cast<std::size_t>((y - crop.y0) * crop.width() + (x - crop.x0));
        same = same && part.find("G")->values[at] == whole.find("G")->values[static_cast<std::size_t>(y * 16 + x)];
      }
    }
    CHECK(same);
  }
}

}  // namespace
}  // namespace tyndall
