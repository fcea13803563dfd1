#include "light/delta_lights.h"

#include <doctest/doctest.h>

#include "light/importance.h"
#include "light_cases.h"

namespace tyndall {
namespace {

TEST_CASE("a point light falls off with the squared distance") {
  const PointEmitter light(PointLight{{1, 2, 3}, {2, 4, 8}});
  const auto a = light.arrival({1, 2, 1});
  REQUIRE(a);
  CHECK(a->L == Rgb(0.5f, 1, 2));
  CHECK(a->distance == 2);
  CHECK(a->wi == Vec3{0, 0, 1});
  CHECK(light.power().r == doctest::Approx(8 * kPi));
  CHECK(!light.arrival({1, 2, 3}));
  CHECK(!PointEmitter({{}, Rgb(1)}).arrival({1e-30f, 0, 0}));  // the irradiance would not be finite
  CHECK(PointEmitter({{}, Rgb(1)}).arrival({1e30f, 0, 0}));
}

TEST_CASE("a spot light: full inside, nothing outside, smoothstep between") {
  const SpotEmitter light(SpotLight{Transform::translate(0, 0, 5) * Transform::rotate(180, 1, 0, 0), Rgb(3), 40, 20});
  const auto E = [&](double degrees) {
    const double t = degrees * kPi / 180;
    const auto a = light.arrival({static_cast<float>(std::sin(t)), 0, 5 - static_cast<float>(std::cos(t))});
    return a ? a->L.r : 0;
  };
  CHECK(E(0) == doctest::Approx(3));
  CHECK(E(19.9) == doctest::Approx(3));
  CHECK(E(40.1) == 0);
  CHECK(E(120) == 0);
  const double c =
      (std::cos(30 * kPi / 180) - std::cos(40 * kPi / 180)) / (std::cos(20 * kPi / 180) - std::cos(40 * kPi / 180));
  CHECK(E(30) == doctest::Approx(3 * c * c * (3 - 2 * c)).epsilon(1e-4));
}

TEST_CASE("the power of a spot light is the integral of its intensity") {
  const SpotLight description{{}, Rgb(1), 70, 35};
  const SpotEmitter light(description);
  double sum = 0;
  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const double z = 1 - 2 * (i + 0.5) / kSteps;
    const auto a = light.arrival({static_cast<float>(std::sqrt(1 - z * z)), 0, static_cast<float>(z)});
    sum += (a ? a->L.r : 0) * 4 * kPi / kSteps;
  }
  CHECK(light.power().r == doctest::Approx(sum).epsilon(1e-3));
}

TEST_CASE("spot cones from 0 to 180 degrees, under any transform: the bounds hold all that is lit") {
  Rng rng(6);
  std::size_t lit = 0;
  for (const float cone : {1e-4f, 0.01f, 5.0f, 90.0f, 135.0f, 179.999f, 180.0f})
    for (const float delta : {0.0f, 1e-5f, 3.0f, 180.0f})
      for (int k = 0; k < 4; ++k) {
        Transform t = Transform::translate(1, -2, 3) * Transform::rotate(123, 3, 1, 2);
        if (k == 1) t = t * Transform::scale(-2, 2, 2);
        if (k == 2) t = t * Transform::scale(1, 3, 0.2);
        if (k == 3) t = t * Transform::scale(1e-12, 1e-12, 1e-12);
        const SpotEmitter light(SpotLight{t, Rgb(1), cone, std::max(cone - delta, 0.0f)});
        LightBounds bounds = light.bounds();
        bounds.intensity = 1;
        const ClusterBounds cluster = ClusterBounds::from(bounds);
        for (int i = 0; i < 2000; ++i) {
          const Vec3 axis = normalize(t.vector({0, 0, 1}));
          const float spread = std::pow(10.0f, 1 - 7 * rng.uniform());
          const Vec3 p = Vec3{1, -2, 3} + normalize(axis + test::random_in_cube(rng, spread)) * std::exp(4 * rng.uniform() - 2);
          const PointQuery q{p, {}};
          const auto a = light.arrival(p);
          if (!a || is_black(a->L)) continue;
          ++lit;
          REQUIRE(is_finite(a->L));
          REQUIRE(importance(cluster, false, q) > 0);
        }
      }
  CHECK(lit > 50'000);
}

TEST_CASE("a distant light arrives from its direction") {
  const DistantEmitter light(DistantLight{{0, -2, 0}, Rgb(5)});
  CHECK(light.arrival().wi == Vec3{0, 1, 0});
  CHECK(light.arrival().distance == kInfinity);
  CHECK(light.arrival().L == Rgb(5));
}

}  // namespace
}  // namespace tyndall
