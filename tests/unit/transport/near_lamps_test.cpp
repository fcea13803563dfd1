/// Distances to the nearest lamp, by brute force.
#include "transport/near_lamps.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "math/rng.h"

namespace tyndall {
namespace {

Vec3 random_point(const Bounds3& box, Rng& rng) {
  const float x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
  return box.min + box.extent() * Vec3{x, y, z};
}

float nearest(const std::vector<NearLamps::Lamp>& lamps, Vec3 p) {
  float least = kInfinity;
  for (const NearLamps::Lamp& lamp : lamps) least = std::min(least, std::max(length(p - lamp.center) - lamp.radius, 0.0f));
  return least;
}

TEST_CASE("the nearest lamp is as far as is said, less the size of a cube, lamps outside of the box included") {
  Rng rng(8);
  for (const Vec3 size : {Vec3{2, 2, 2}, Vec3{1, 6, 2}, Vec3{3, 3, 0.01f}}) {
    const Bounds3 box{{-1, 2, 0}, Vec3{-1, 2, 0} + size}, around{box.min - size, box.max + size};
    const float cube = length(Cubes(box, 1 << 15).step());
    for (const int count : {1, 7, 300}) {
      std::vector<NearLamps::Lamp> lamps;
      for (int i = 0; i < count; ++i) lamps.push_back({random_point(around, rng), 0.1f * rng.uniform()});
      const NearLamps near(box, lamps);
      float most_above = 0;
      for (int i = 0; i < 10'000; ++i) {
        const Vec3 p = random_point(box, rng);
        const float said = near.distance(p), truth = nearest(lamps, p);
        REQUIRE(said >= truth - 1.001f * cube);
        most_above = std::max(most_above, (said - truth) / (truth + cube));
      }
      CHECK(most_above < 0.15f);  // of lamps outside of the box those that come next to one cube may hide each other
    }
  }
}

TEST_CASE("without lamps they are at infinity, and within one there is no distance") {
  const Bounds3 box{{0, 0, 0}, {1, 1, 1}};
  CHECK(NearLamps(box, {}).distance({0.5f, 0.5f, 0.5f}) == kInfinity);
  CHECK(NearLamps(box, {{{0, 0, 0}, 5}}).distance({0.5f, 0.5f, 0.5f}) == 0);
  CHECK(NearLamps().empty());
}

}  // namespace
}  // namespace tyndall
