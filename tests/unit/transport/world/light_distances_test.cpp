/// Distances to the nearest light, by brute force.
#include "transport/world/light_distances.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "math/rng.h"
#include "session/world_parts.h"
#include "support/scene_text.h"
#include "support/sphere_scene.h"

namespace tyndall {
namespace {

Vec3 random_point(const Bounds3& box, Rng& rng) {
  const float x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
  return box.min + box.extent() * Vec3{x, y, z};
}

float nearest(const std::vector<LightDistances::Near>& lights, Vec3 p) {
  float least = kInfinity;
  for (const LightDistances::Near& light : lights)
    least = std::min(least, std::max(length(p - light.center) - light.radius, 0.0f));
  return least;
}

TEST_CASE("the distance to the nearest light is right to the size of a cube, lights outside of the box included") {
  Rng rng(8);
  for (const Vec3 size : {Vec3{2, 2, 2}, Vec3{1, 6, 2}, Vec3{3, 3, 0.01f}}) {
    const Bounds3 box{{-1, 2, 0}, Vec3{-1, 2, 0} + size}, around{box.min - size, box.max + size};
    const float cube = length(Cubes(box, 1 << 15).step());
    for (const int count : {1, 7, 300}) {
      std::vector<LightDistances::Near> lights;
      for (int i = 0; i < count; ++i) lights.push_back({random_point(around, rng), 0.1f * rng.uniform()});
      const LightDistances near(box, lights);
      float most_above = 0;
      for (int i = 0; i < 10'000; ++i) {
        const Vec3 p = random_point(box, rng);
        const float said = near.distance(p), truth = nearest(lights, p);
        REQUIRE(said >= truth - 1.001f * cube);
        most_above = std::max(most_above, (said - truth) / (truth + cube));
      }
      CHECK(most_above < 0.15f);  // of lights outside of the box those that come next to one cube may hide each other
    }
  }
}

TEST_CASE("without lights the distance is infinite, within one it is 0") {
  const Bounds3 box{{0, 0, 0}, {1, 1, 1}};
  CHECK(LightDistances(box, {}).distance({0.5f, 0.5f, 0.5f}) == kInfinity);
  CHECK(LightDistances(box, {{{0, 0, 0}, 5}}).distance({0.5f, 0.5f, 0.5f}) == 0);
  CHECK(LightDistances().empty());
}

// As pbrt's scenes have it: the camera's medium is that of the box around it.
TEST_CASE("fog in a box that holds the camera is as large as the box") {
  const auto world_with = [](const std::string& declared) {
    return test::world_of("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n" + declared +
                              "LookAt 0 0 -1  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n" +
                              test::point_light({0.5f, 0.5f, 0.5f}, 1) + test::medium_box("fog", "", {{-2, -2, -2}, {2, 2, 2}}),
                          {});
  };
  const World inside = world_with("MediumInterface \"\" \"fog\"\n"), told_nothing = world_with("");
  for (const World* world : {&inside, &told_nothing}) {
    const BuiltWorld& built = world->parts().built;
    CHECK_FALSE(built.camera_media.unbounded());
    CHECK_FALSE(built.light_distances.empty());
  }
}

}  // namespace
}  // namespace tyndall
