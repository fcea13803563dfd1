#include "light/bounds.h"

#include <doctest/doctest.h>

#include "light_cases.h"

namespace tyndall {
namespace {

LightBounds oriented(float theta_o, float theta_e) {
  LightBounds b;
  b.box.expand(Vec3{});
  b.normals = DirectionCone::around({0, 0, 1}, theta_o);
  b.theta_e = theta_e;
  b.intensity = 1;
  return b;
}

TEST_CASE("the orientation measure of known cones") {
  CHECK(orientation_measure(oriented(0, kPi / 2)) == doctest::Approx(kPi));        // one normal, cosine emission
  CHECK(orientation_measure(oriented(kPi, kPi / 2)) == doctest::Approx(4 * kPi));  // every direction
  CHECK(orientation_measure(oriented(0, 0)) == doctest::Approx(0));
  LightBounds both = oriented(0, kPi / 2);
  both.two_sided = true;
  CHECK(orientation_measure(both) == doctest::Approx(2 * kPi));
}

TEST_CASE("the orientation measure is the integral it stands for") {
  for (const float o : {0.2f, 0.9f, 1.8f, 3.0f})
    for (const float e : {0.1f, 0.7f, 1.5f}) {
      const double w = std::min<double>(o + e, kPi);
      double sum = 2 * kPi * (1 - std::cos(double(o)));
      constexpr int kSteps = 20'000;
      for (int i = 0; i < kSteps; ++i) {
        const double t = o + (w - o) * (i + 0.5) / kSteps;
        sum += 2 * kPi * std::cos(t - o) * std::sin(t) * (w - o) / kSteps;
      }
      CHECK(orientation_measure(oriented(o, e)) == doctest::Approx(sum).epsilon(1e-5));
    }
}

TEST_CASE("bounds of a pair hold both boxes, both powers and both cones") {
  Rng rng(4);
  for (int i = 0; i < 10'000; ++i) {
    const auto pair = test::mixed_lights(2, rng.next());
    const LightBounds u = bounds_union(pair[0], pair[1]);
    REQUIRE(u.intensity == pair[0].intensity + pair[1].intensity);
    REQUIRE(u.theta_e == std::max(pair[0].theta_e, pair[1].theta_e));
    for (const LightBounds& l : pair) {
      REQUIRE((u.box.contains(l.box.min) && u.box.contains(l.box.max)));
      REQUIRE((!l.two_sided || u.two_sided));
      double d = angle_between(u.normals.axis, l.normals.axis);
      if (u.two_sided) d = std::min(d, angle_between(-u.normals.axis, l.normals.axis));
      REQUIRE((u.normals.full() || d + l.normals.theta <= u.normals.theta + 1e-6));
    }
  }
}

TEST_CASE("empty bounds are the neutral element") {
  const LightBounds b = test::point_bounds({1, 2, 3}, 5);
  CHECK(bounds_union({}, b).intensity == 5);
  CHECK(bounds_union(b, {}).box.min == b.box.min);
  CHECK(bounds_union({}, {}).box.empty());
  CHECK(size_measure(Bounds3{}) == 0);
}

TEST_CASE("two-sided triangles that lie back to back keep a narrow cone") {
  const LightBounds up = test::triangle_bounds({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, true, 1);
  const LightBounds down = test::triangle_bounds({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, true, 1);
  CHECK(bounds_union(up, down).normals.theta < 1e-5f);
}

}  // namespace
}  // namespace tyndall
