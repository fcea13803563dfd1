#include "light/portal.h"

#include <doctest/doctest.h>

#include "environment_maps.h"
#include "light/importance.h"
#include "light/lights.h"
#include "light_cases.h"
#include "support/chi_squared.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// A window of 2 x 1 in the plane x = -2, through which light comes from -x.
std::array<Vec3, 4> window() { return {Vec3{-2, 0, 0}, Vec3{-2, 1, 0}, Vec3{-2, 1, 2}, Vec3{-2, 0, 2}}; }

InfiniteLight through_window(const std::string& map = {}) {
  InfiniteLight light;
  light.L = {1, 2, 3};
  light.path = map;
  light.portal = window();
  if (!map.empty()) light.to_world = Transform::rotate(-90, 1, 0, 0);
  return light;
}

Rgb lobes(int x, int y) { return Rgb((x * 7 + y * 3) % 5 == 0 ? 20.0f : 0.1f * float(x + y)); }

constexpr std::array<Vec3, 4> kPlaces{{{0, 0.5f, 1}, {-1.9f, 0.1f, 0.2f}, {3, -4, 5}, {-1.7f, 2.5f, 1}}};

TEST_CASE("light of a portal comes from the directions that lead through it, and from no other") {
  const Portal portal(through_window(), {});
  Rng rng(1);
  int through = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = test::random_in_cube(rng, 4), w = test::random_direction(rng);
    const float t = (-2 - p.x) / w.x;
    const Vec3 at = p + w * t;
    const bool leads = w.x < 0 && t > 0 && at.y > 0 && at.y < 1 && at.z > 0 && at.z < 2;
    through += leads;
    REQUIRE(portal.radiance(p, w) == (leads ? Rgb(1, 2, 3) : Rgb()));
    REQUIRE((portal.pdf(p, w) > 0) == leads);
  }
  CHECK(through > 80);
}

TEST_CASE("portals are sampled by their density, constant ones and maps") {
  for (const bool mapped : {false, true}) {
    const test::ScratchMap map("portal", 16, 16, lobes);
    const Portal portal(through_window(mapped ? map.path() : ""), {});
    for (const Vec3 p : kPlaces) {
      const Vec3 toward = normalize(Vec3{-2, 0.5f, 1} - p);
      const auto result = test::chi_squared_test(
          [&](const test::Uniform& random) -> std::optional<Vec3> {
            const float x = random(), y = random();
            const auto s = portal.sample(p, {x, y});
            if (!s) return std::nullopt;
            REQUIRE(s->pdf == portal.pdf(p, s->wi));
            REQUIRE(s->L == portal.radiance(p, s->wi));
            return s->wi;
          },
          [&](Vec3 w) { return portal.pdf(p, w); },
          {.samples = 50'000, .theta_bins = 16, .phi_bins = 24, .axis = toward, .theta_power = 2, .alpha = 1e-5});
      CHECK_MESSAGE(result.passed, mapped, " ", result.summary());
      CHECK(result.sampled_fraction > 0.999);
    }
  }
}

TEST_CASE("a constant portal lights like an area light of its radiance") {
  const Portal portal(through_window(), {});
  // pi L A enters.
  CHECK(portal.power() == doctest::Approx(kPi * 2 * 2).epsilon(2e-3));
  Rng rng(5);
  for (const Vec3 p : {Vec3{0.5f, 1.5f, -1}, Vec3{-1.99f, 3, 1}}) {  // the second sees it nearly edge-on
    double sampled = 0, expected = 0;
    constexpr int kSamples = 40'000, kSteps = 200;
    for (int i = 0; i < kSamples; ++i) {
      const float x = rng.uniform(), y = rng.uniform();
      if (const auto s = portal.sample(p, {x, y})) sampled += s->L.g / s->pdf / kSamples;
    }
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const Vec3 q = Vec3{-2, (float(i) + 0.5f) / kSteps, 2 * (float(j) + 0.5f) / kSteps} - p;
        expected += 2 * std::abs(q.x) / std::pow(length(q), 3) * 2 / (kSteps * kSteps);
      }
    CHECK(sampled == doctest::Approx(expected).epsilon(3e-3));
  }
}

TEST_CASE("where a portal's light arrives, its bounds say so; what is behind it is dark") {
  const Portal portal(through_window(), {});
  const ClusterBounds cluster = ClusterBounds::from(portal.bounds());
  Rng rng(2);
  for (int i = 0; i < 5'000; ++i) {
    const Vec3 p = test::random_in_cube(rng, 4), n = i % 2 ? test::random_direction(rng) : Vec3{};
    const float x = rng.uniform(), y = rng.uniform();
    const auto s = portal.sample(p, {x, y});
    if (p.x < -2) CHECK(!s);
    if (s && (length(n) == 0 || dot(n, s->wi) > 0)) REQUIRE(importance(cluster, false, PointQuery{p, n}) > 0);
  }
  CHECK(importance(cluster, false, PointQuery{{-6, 0.5f, 1}, {}}) == 0);
}

TEST_CASE("lights: a portal is a light at infinity for rays, and near for the choice of lights") {
  Scene scene;
  scene.lights = {{PointLight{{0, 0, 0}, Rgb(1)}, {}}, {through_window(), {}}};
  const Lights lights = build_lights(scene, {}, {{-2, 0, 0}, {2, 1, 2}});
  REQUIRE(lights.infinite().size() == 1);
  const LightSelector& selector = lights.selector(lights.selectors()[0].strategy);
  CHECK(selector.pmf(PointQuery{{-6, 0.5f, 1}, {}}, 1) == 0);
  CHECK(selector.pmf(PointQuery{{-1, 0.5f, 1}, {}}, 1) > 0);
  const Ray ray{{0, 0.5f, 1}, {-1, 0, 0}};
  CHECK(lights.environment(1, ray) == Rgb(1, 2, 3));
  const auto s = lights.sample(1, ray.o, {0.3f, 0.6f});
  REQUIRE(s);
  CHECK(s->distance == kInfinity);
  CHECK(s->pdf == lights.environment_pdf(1, {ray.o, s->wi}));
  CHECK(is_black(lights.environment(1, {{0, 0.5f, 1}, {1, 0, 0}})));
}

TEST_CASE("portals that are no rectangles are refused") {
  InfiniteLight light = through_window();
  (*light.portal)[2] = {-2, 2, 2};
  CHECK_THROWS_WITH_AS(Portal(light, {"a.pbrt", 3, 4}), doctest::Contains("a.pbrt:3:4: the portal is no rectangle"), Error);
  light.portal = {Vec3{}, Vec3{}, Vec3{}, Vec3{}};
  CHECK_THROWS_AS(Portal(light, {}), Error);
}

}  // namespace
}  // namespace tyndall
