#include "light/cone.h"

#include <doctest/doctest.h>

#include "light_cases.h"
#include "support/relative.h"

namespace tyndall {
namespace {

DirectionCone random_cone(Rng& rng) {
  const float u = rng.uniform();
  const float theta = u < 0.3f ? 0 : (u < 0.5f ? std::pow(10.0f, -6 * rng.uniform()) : kPi * rng.uniform());
  return DirectionCone::around(test::random_direction(rng), theta);
}

/// A second cone that stands in some awkward relation to the first.
DirectionCone partner_of(const DirectionCone& a, Rng& rng) {
  DirectionCone b = random_cone(rng);
  switch (rng.next() % 6) {
    case 0:
      b.axis = a.axis;
      break;
    case 1:
      b.axis = -a.axis;
      break;
    case 2:
      b.axis.x = std::nextafter(a.axis.x, 2.0f), b.axis.y = a.axis.y, b.axis.z = a.axis.z;
      break;
    case 3:
      b.axis = normalize(-a.axis + test::random_in_cube(rng, 1e-6f));
      break;
    case 4:
      b.axis = normalize(a.axis + test::random_in_cube(rng, 1e-4f));
      break;
    default:
      break;
  }
  return b;
}

bool holds(const DirectionCone& outer, const DirectionCone& inner) {
  return outer.full() || angle_between(outer.axis, inner.axis) + inner.theta <= outer.theta + 1e-9;
}

TEST_CASE("the union of two cones contains both, has a unit axis and is as narrow as can be") {
  Rng rng(1);
  for (int i = 0; i < 1'000'000; ++i) {
    const DirectionCone a = random_cone(rng), b = partner_of(a, rng), u = cone_union(a, b);
    REQUIRE(std::abs(length(u.axis) - 1) < 1e-6f);
    REQUIRE(u.theta >= 0);
    REQUIRE(holds(u, a));
    REQUIRE(holds(u, b));
    const double least = std::max<double>({a.theta, b.theta, 0.5 * (a.theta + b.theta + angle_between(a.axis, b.axis))});
    REQUIRE(u.theta <= std::min<double>(least + 1e-6, kPi));
  }
}

TEST_CASE("the empty cone changes nothing, the full one takes all") {
  const DirectionCone a = DirectionCone::around({0, 1, 0}, 0.3f);
  CHECK(cone_union(a, {}).theta == a.theta);
  CHECK(cone_union({}, a).axis == a.axis);
  CHECK(cone_union({}, {}).empty());
  CHECK(cone_union(a, DirectionCone::everything()).full());
}

TEST_CASE("angles keep their digits near 0 and pi") {
  const float tiny = 1e-5f;
  CHECK(angle_between({1, 0, 0}, {1, tiny, 0}) == test::relative(1e-5).epsilon(1e-4));
  CHECK(angle_between({1, 0, 0}, {-1, 0, 0}) == doctest::Approx(3.14159265358979).epsilon(1e-12));
  CHECK(angle_between({1, 0, 0}, {1, 0, 0}) == 0);
}

}  // namespace
}  // namespace tyndall
