/// Points near a lamp, drawn as directions and distances together: both follow their densities, near and far.
#include "render/lamp_aim.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "math/rng.h"
#include "math/vec3d.h"
#include "support/chi_squared.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

struct Place {
  Vec3 p, lamp;
};
constexpr Place kPlaces[] = {
    {{0, 0, 0}, {0, 0, 1}},
    {{1, 2, 3}, {1.01f, 2, 3}},
    {{-5, 0.1f, 4}, {400, -70, 30}},
    {{0, 0, 0}, {0x1p-40f, 0x1p-41f, 0}},
    {{0, 0, 0}, {0, -0x1p40f, 0}},
};

/// 1/length, at distance `t` on the ray of `aim`.
double distance_pdf(const Place& place, const LampAim& aim, double t) {
  const Vec3d to_lamp = Vec3d(place.lamp) - Vec3d(place.p) - Vec3d(aim.w) * t;
  return 1 / (double{aim.spread} * aim.pdf * dot(to_lamp, to_lamp));
}

/// Simpson's rule in the angle that the lamp sees, so that a peak is as good as a plain.
double probability(const Place& place, const LampAim& aim, double t0, double t1) {
  const Vec3d to_lamp = Vec3d(place.lamp) - Vec3d(place.p), w(aim.w);
  const double closest = dot(to_lamp, w), passing = length(to_lamp - w * closest);
  const double a0 = std::atan((t0 - closest) / passing), a1 = std::atan((t1 - closest) / passing);
  constexpr int kSteps = 200;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double a = a0 + (a1 - a0) * i / kSteps, t = closest + passing * std::tan(a);
    sum += distance_pdf(place, aim, t) * passing / (std::cos(a) * std::cos(a)) * (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2);
  }
  return sum * (a1 - a0) / kSteps / 3;
}

}  // namespace

TEST_CASE("directions toward a lamp follow their density") {
  for (const Place& place : kPlaces) {
    const auto result = chi_squared_test(
        [&](const Uniform& random) -> std::optional<Vec3> {
          const float x = random();
          const Vec2 around{x, random()};
          const auto aim = aim_near(place.p, place.lamp, around, random());
          return aim ? std::optional(aim->w) : std::nullopt;
        },
        [&](Vec3 w) { return std::min(aim_pdf(place.p, place.lamp, w), 1e30f); },  // bins have no area at the pole
        {.axis = normalize(place.lamp - place.p), .theta_power = 4, .alpha = sidak(1e-3, std::size(kPlaces))});
    CHECK_MESSAGE(result.passed, result.summary());
    CHECK(result.density_integral == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("distances near a lamp follow their density, on rays that pass it closely or not") {
  constexpr int kDraws = 100'000;
  Rng rng(7);
  for (const Place& place : kPlaces) {
    const double distance = length(Vec3d(place.lamp) - Vec3d(place.p));
    for (const float around : {0.001f, 0.1f, 0.5f, 0.999f}) {
      const auto ray = aim_near(place.p, place.lamp, {around, 0.3f}, 0.5f);
      REQUIRE(ray);
      CHECK(aim_pdf(place.p, place.lamp, ray->w) == doctest::Approx(ray->pdf).epsilon(around < 0.01f ? 1e-2 : 1e-3));
      std::vector<double> edges{0};
      for (const double x : {0.5, 0.9, 0.97, 0.99, 0.999, 1.0, 1.001, 1.01, 1.03, 1.1, 1.5, 3.0, 1e5}) edges.push_back(x * distance);
      std::vector<double> pmf, counts(edges.size(), 0.0);
      double sum = 0;
      for (std::size_t i = 0; i + 1 < edges.size(); ++i) sum += pmf.emplace_back(probability(place, *ray, edges[i], edges[i + 1]));
      CHECK(sum == doctest::Approx(1).epsilon(2e-3));
      pmf.push_back(std::max(0.0, 1 - sum));
      for (int k = 0; k < kDraws; ++k) {
        const auto aim = aim_near(place.p, place.lamp, {around, 0.3f}, rng.uniform());
        if (!aim) continue;
        counts[std::upper_bound(edges.begin(), edges.end(), double{aim->t}) - edges.begin() - 1] += 1;
      }
      CHECK(count_p_value(counts, pmf, kDraws) > sidak(1e-3, 20));
    }
  }
}

TEST_CASE("nothing is drawn for a lamp where one stands, and none off its cone") {
  CHECK_FALSE(aim_near({1, 2, 3}, {1, 2, 3}, {0.5f, 0.5f}, 0.5f));
  CHECK_FALSE(aim_near({0, 0, 0}, {0, 0, 1}, {0, 0.5f}, 0.5f));
  CHECK(aim_pdf({0, 0, 0}, {0, 0, 1}, {0, 0, -1}) == 0);
  CHECK(aim_pdf({0, 0, 0}, {0, 0, 1}, normalize(Vec3{0.4f, 0, 1})) == 0);
  CHECK(aim_pdf({0, 0, 0}, {0, 0, 0}, {0, 0, 1}) == 0);
  CHECK(aim_pdf({0, 0, 0}, {0, 0, 1}, {0, 0, 1}) == kInfinity);
}
