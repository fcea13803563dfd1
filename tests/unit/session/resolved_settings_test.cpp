#include "session/resolved_settings.h"

#include <doctest/doctest.h>

#include <string>

#include "support/scene_text.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

namespace tyndall {
namespace {

World world(const std::string& things) {
  const std::string text =
      test::view({.eye = {0, 0, -2}, .look = {0, 0, 0}, .fov_degrees = 40}) + test::diffuse_plane(1, 3, 0.5f) + things;
  return build(read_scene_text(text, "test.pbrt").scene, {});
}

std::string cloud(float Le = 0) {
  const test::Grid grid{{{-1, -1, -1}, {1, 1, 0.5f}}, 1, 1, 1, {1}};
  return test::uniform_grid("m", {.sigma_a = Rgb(1), .sigma_s = Rgb(1), .Le = Rgb(Le)}, grid) +
         test::medium_box("m", "", grid.bounds);
}

OpenChoices open_in(const World& world, const RenderSettings& given) {
  return open_choices(given, resolved(given, world.parts()), world.parts());
}

TEST_CASE("what options leave open and can make a difference is open") {
  const World smoke = world(test::distant_light({0.2f, 0.1f, 1}, 3) + cloud());
  const OpenChoices all = open_in(smoke, {});
  CHECK(all.sharing);
  CHECK(all.pairs);
  CHECK(all.guiding);
  const OpenChoices clear = open_in(world(test::point_light({0, 0, -1}, 1)), {});
  CHECK(clear.sharing);
  CHECK_FALSE(clear.pairs);
  CHECK_FALSE(clear.guiding);
  RenderSettings once;
  once.max_depth = 1;
  const OpenChoices single = open_in(smoke, once);
  CHECK_FALSE(single.sharing);
  CHECK(open_in(world(test::environment(1) + cloud()), once).sharing);
  CHECK(single.pairs);
  CHECK_FALSE(single.guiding);
  CHECK_FALSE(all.emission);
  CHECK(open_in(world(cloud(1)), {}).emission);
}

TEST_CASE("paths have so many bounces at most") {
  const World smoke = world(cloud());
  RenderSettings settings;
  settings.max_depth = kMostBounces;
  CHECK_NOTHROW(resolved(settings, smoke.parts()));
  for (const int depth : {-1, kMostBounces + 1}) {
    settings.max_depth = depth;
    CHECK_THROWS_AS(resolved(settings, smoke.parts()), Error);
  }
}

TEST_CASE("no more lights are asked than a render can end with") {
  const World smoke = world(cloud());
  const auto require_bounds = [&](auto set, int most) {
    for (const int count : {0, most}) CHECK_NOTHROW(resolved(set(count), smoke.parts()));
    for (const int count : {-1, most + 1, 2'000'000'000}) CHECK_THROWS_AS(resolved(set(count), smoke.parts()), Error);
  };
  require_bounds([](int count) { return RenderSettings{.candidates = count}; }, kMostLights);
  require_bounds([](int count) { return RenderSettings{.shadow_rays = count}; }, kMostLights);
  require_bounds([](int count) { return RenderSettings{.threads = count}; }, kMostThreads);
}

TEST_CASE("what options say is not open") {
  const World smoke = world(test::distant_light({0.2f, 0.1f, 1}, 3) + cloud());
  const World burning = world(cloud(1));
  RenderSettings sharing, emission, pairs, distance, guiding, fixed, others;
  emission.emission = EmissionStrategy::lights;
  sharing.reuse = ReuseStrategy::pixels;
  pairs.media = MediaStrategy::product;
  distance.distance = DistanceStrategy::profile;
  guiding.guiding = GuidingStrategy::media;
  fixed.budget = BudgetStrategy::fixed;
  others.media = MediaStrategy::vertex;
  CHECK_FALSE(open_in(smoke, sharing).sharing);
  CHECK_FALSE(open_in(burning, emission).emission);
  CHECK_FALSE(open_in(smoke, pairs).pairs);
  CHECK_FALSE(open_in(smoke, distance).pairs);
  CHECK_FALSE(open_in(smoke, guiding).guiding);
  CHECK_FALSE(open_in(smoke, fixed).any());
  CHECK_FALSE(open_in(smoke, others).any());
}

}  // namespace
}  // namespace tyndall
