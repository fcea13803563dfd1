/// Places near a point light, drawn as direction and distance together: both follow their densities, near and far.
#include "transport/techniques/point_aim.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/rng.h"
#include "math/vec3d.h"
#include "support/chi_squared.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

struct Place {
  Vec3 p, point;
};
constexpr Place kPlaces[] = {
    {{0, 0, 0}, {0, 0, 1}},          {{1, 2, 3}, {1.01f, 2, 3}},
    {{-5, 0.1f, 4}, {400, -70, 30}}, {{0, 0, 0}, {0x1p-40f, 0x1p-41f, 0}},
    {{0, 0, 0}, {0, -0x1p40f, 0}},
};

constexpr float kMeanCosines[] = {0, 0.4f, -0.7f, 0.95f};

/// Of the ray of `aim`: how far it is along it to where it passes the light, and how closely it does.
std::pair<double, double> passing_of(const Place& place, const PointAim& aim) {
  const Vec3d to_point = Vec3d(place.point) - Vec3d(place.p), w(aim.w);
  return {dot(to_point, w), length(to_point - w * dot(to_point, w))};
}

/// Probability of distances from 0 to `t`, before it is normalised: the integral over the angle theta that light turns by of
/// 1 / (1 + h^2 - 2 h cos(theta)), where ((1 + h) / (1 - h)) = ((1 + g) / (1 - g))^1.2, by Simpson's rule.
double unnormalised(double closest, double passing, double g, double t) {
  const double a = std::pow((1 + g) / (1 - g), 1.2), h = (a - 1) / (a + 1);
  const auto theta = [&](double x) { return kPi / 2 + std::atan((x - closest) / passing); };
  const double begin = theta(0), end = t < 1e300 ? theta(t) : double{kPi};
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double f = 1 / (1 + h * h - 2 * h * std::cos(begin + (end - begin) * i / kSteps));
    sum += f * (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2);
  }
  return sum * (end - begin) / kSteps / 3;
}

}  // namespace

TEST_CASE("directions toward a point light follow their density") {
  for (const Place& place : kPlaces) {
    const auto result = chi_squared_test(
        [&](const Uniform& random) -> std::optional<Vec3> {
          const float x = random();
          const Vec2 around{x, random()};
          const auto aim = aim_near(place.p, place.point, 0.4f, around, random());
          return aim ? std::optional(aim->w) : std::nullopt;
        },
        [&](Vec3 w) { return std::min(aim_pdf(place.p, place.point, w), 1e30f); },  // bins have no area at the pole
        {.axis = normalize(place.point - place.p), .theta_power = 4, .alpha = sidak(1e-3, std::size(kPlaces))});
    CHECK_MESSAGE(result.passed, result.summary());
    CHECK(result.density_integral == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("distances near a point light follow their density, on rays that pass it closely or not") {
  constexpr int kDraws = 20'000;
  Rng rng(7);
  for (const Place& place : kPlaces) {
    const double distance = length(Vec3d(place.point) - Vec3d(place.p));
    for (const float around : {0.001f, 0.1f, 0.5f, 0.999f}) {
      for (const float g : kMeanCosines) {
        const auto ray = aim_near(place.p, place.point, g, {around, 0.3f}, 0.5f);
        REQUIRE(ray);
        CHECK(aim_pdf(place.p, place.point, ray->w) == doctest::Approx(ray->pdf).epsilon(around < 0.01f ? 1e-2 : 1e-3));
        const auto [closest, passing] = passing_of(place, *ray);
        const double whole = unnormalised(closest, passing, g, 1e300);
        std::vector<double> edges{0}, pmf;
        for (const double x : {0.5, 0.9, 0.97, 0.99, 0.999, 1.0, 1.001, 1.01, 1.03, 1.1, 1.5, 3.0, 1e5}) {
          edges.push_back(x * distance);
        }
        std::vector<double> counts(edges.size(), 0.0), below;
        for (const double t : edges) below.push_back(unnormalised(closest, passing, g, t) / whole);
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) pmf.push_back(below[i + 1] - below[i]);
        pmf.push_back(1 - below.back());
        for (int k = 0; k < kDraws; ++k) {
          const auto aim = aim_near(place.p, place.point, g, {around, 0.3f}, rng.uniform());
          if (!aim) continue;
          counts[std::upper_bound(edges.begin(), edges.end(), double{aim->t}) - edges.begin() - 1] += 1;
        }
        CHECK(count_p_value(counts, pmf, kDraws) > sidak(1e-3, 80));
      }
    }
  }
}

// The derivative of the distance by the number that it is drawn with is 1 / its density.
TEST_CASE("the density of a distance near a point light is that of drawing it") {
  for (const float closest : {-2.0f, 0.0f, 0.3f, 5.0f}) {
    for (const float g : kMeanCosines) {
      constexpr float kStep = 0x1p-8f, kPassing = 0.5f;
      for (float u = 2 * kStep; u < 0.99f; u += kStep) {
        const auto angle = [&](float v) {
          return std::atan((double{pass_point(closest, kPassing, g, v).t} - closest) / kPassing);
        };
        const double slope = (angle(u + kStep) - angle(u - kStep)) / (2 * kStep);
        CHECK(slope == doctest::Approx(pass_point(closest, kPassing, g, u).spread * kPassing).epsilon(0.01));
      }
    }
  }
}

TEST_CASE("nothing is drawn where the point light itself stands, and none off its cone") {
  CHECK_FALSE(aim_near({1, 2, 3}, {1, 2, 3}, 0, {0.5f, 0.5f}, 0.5f));
  CHECK_FALSE(aim_near({0, 0, 0}, {0, 0, 1}, 0, {0, 0.5f}, 0.5f));
  CHECK(aim_pdf({0, 0, 0}, {0, 0, 1}, {0, 0, -1}) == 0);
  CHECK(aim_pdf({0, 0, 0}, {0, 0, 1}, normalize(Vec3{0.4f, 0, 1})) == 0);
  CHECK(aim_pdf({0, 0, 0}, {0, 0, 0}, {0, 0, 1}) == 0);
  CHECK(aim_pdf({0, 0, 0}, {0, 0, 1}, {0, 0, 1}) == kInfinity);
}
