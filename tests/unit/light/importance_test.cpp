#include "light/importance.h"

#include <doctest/doctest.h>

#include "contribution_oracle.h"
#include "light_cases.h"
#include "support/relative.h"

namespace tyndall {
namespace {

TEST_CASE("importance is 0 only where nothing can contribute: a million clusters, points and normals by brute force") {
  Rng rng(2024);
  int contributing = 0, culled = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const int count = 1 + static_cast<int>(rng.next() % 3);
    std::array<test::ContributionOracle, 3> lights;
    LightBounds cluster;
    for (int k = 0; k < count; ++k) {
      lights[k] = test::random_light(rng);
      if (k > 0 && rng.uniform() < 0.5f && lights[k].kind == lights[0].kind) lights[k].b = lights[0].b;
      const LightBounds b = lights[k].bounds();
      if (!(b.intensity > 0)) continue;
      cluster = bounds_union(cluster, b);
    }
    if (cluster.box.empty()) continue;
    const PointQuery q = test::random_query(lights[0], rng);
    const double value = importance(ClusterBounds::from(cluster), cluster.two_sided, q);
    REQUIRE(std::isfinite(value));
    if (value > 0) continue;
    ++culled;
    for (int k = 0; k < count; ++k) {
      if (!(lights[k].bounds().intensity > 0)) continue;
      for (const auto& [u, v] : {std::array{0.f, 0.f}, std::array{1.f, 0.f}, std::array{0.f, 1.f},
                                 std::array{rng.uniform(), rng.uniform()}, std::array{rng.uniform(), rng.uniform()}})
        if (lights[k].contributes(q, u, v)) ++contributing;
    }
  }
  CHECK(contributing == 0);
  CHECK(culled > 100'000);  // the test must mean something
}

TEST_CASE("the least importance is no more than what any point of any light gives") {
  Rng rng(11);
  int positive = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::array<test::ContributionOracle, 2> lights;
    LightBounds cluster;
    Vec3 facing = test::random_direction(rng);
    for (auto& l : lights) {
      const float size = 0.3f * rng.uniform();
      l = {.kind = test::ContributionOracle::Kind::triangle, .a = test::random_in_cube(rng, 0.3f), .b = {}, .c = {}};
      l.b = l.a + test::random_in_cube(rng, size);
      l.c = l.a + test::random_in_cube(rng, size);
      if (dot(cross(l.b - l.a, l.c - l.a), facing) < 0) std::swap(l.b, l.c);
      cluster = bounds_union(cluster, l.bounds());
    }
    if (!(cluster.intensity > 0)) continue;
    const PointQuery q{facing * (1 + 3 * rng.uniform()) + test::random_in_cube(rng),
                       normalize(test::random_in_cube(rng, 0.5f) - facing)};
    const ClusterBounds bounds = ClusterBounds::from(cluster);
    const double least = least_importance(bounds, cluster.two_sided, q);
    REQUIRE(least <= importance(bounds, cluster.two_sided, q) * (1 + 1e-9));
    if (least == 0) continue;
    ++positive;
    for (const auto& l : lights) {
      const float u = rng.uniform(), v = rng.uniform() * (1 - u);
      const Vec3d x = Vec3d(l.a) + (Vec3d(l.b) - Vec3d(l.a)) * u + (Vec3d(l.c) - Vec3d(l.a)) * v, to = x - Vec3d(q.p);
      const Vec3d n = normalize(cross(Vec3d(l.b) - Vec3d(l.a), Vec3d(l.c) - Vec3d(l.a)));
      const double d2 = dot(to, to), given = -dot(n, to) * dot(Vec3d(q.n), to) / (d2 * d2);
      REQUIRE(least / cluster.intensity <= given * (1 + 1e-5));
    }
  }
  CHECK(positive > 20'000);
}

TEST_CASE("the greatest importance is no less than what all lights of a cluster give together, wherever they are") {
  Rng rng(12);
  int finite = 0, tight = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::array<test::ContributionOracle, 3> lights;
    LightBounds cluster;
    for (auto& l : lights) {
      const float size = 0.3f * rng.uniform();
      l = {.kind = test::ContributionOracle::Kind::triangle, .a = test::random_in_cube(rng, 0.3f), .b = {}, .c = {}};
      l.b = l.a + test::random_in_cube(rng, size);
      l.c = l.a + test::random_in_cube(rng, size);
      cluster = bounds_union(cluster, l.bounds());
    }
    if (!(cluster.intensity > 0)) continue;
    PointQuery q{test::random_direction(rng) * (2 * rng.uniform()), test::random_direction(rng)};
    if (i % 4 == 0) q.n = {};
    const ClusterBounds bounds = ClusterBounds::from(cluster);
    const double most = greatest_importance(bounds, cluster.two_sided, q);
    REQUIRE(most >= importance(bounds, cluster.two_sided, q) * (1 - 1e-9));
    if (std::isinf(most)) {
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(q.p[axis] >= cluster.box.min[axis] - 1e-6f);
        CHECK(q.p[axis] <= cluster.box.max[axis] + 1e-6f);
      }
      continue;
    }
    ++finite;
    double given = 0;
    for (const auto& l : lights) {
      const float u = rng.uniform(), v = rng.uniform() * (1 - u);
      const Vec3d x = Vec3d(l.a) + (Vec3d(l.b) - Vec3d(l.a)) * u + (Vec3d(l.c) - Vec3d(l.a)) * v, to = x - Vec3d(q.p);
      const Vec3d normal = cross(Vec3d(l.b) - Vec3d(l.a), Vec3d(l.c) - Vec3d(l.a));
      if (!(l.bounds().intensity > 0)) continue;
      const double d = std::sqrt(dot(to, to)), out = -dot(normalize(normal), to) / d;
      const double in = length_squared(q.n) > 0 ? dot(Vec3d(q.n), to) / d : 1;
      given += l.bounds().intensity * std::max(out, 0.0) * std::max(in, 0.0) / (d * d);
    }
    REQUIRE(given <= most * (1 + 1e-5));
    tight += given > 0.5 * most;
  }
  CHECK(finite > 150'000);
  CHECK(tight > 1000);  // it is a bound that says something
}

TEST_CASE("importance of a small far light is its irradiance") {
  const LightBounds light = test::triangle_bounds({0, 0, 0}, {0.001f, 0, 0}, {0, 0.001f, 0}, false, 2);
  const ClusterBounds b = ClusterBounds::from(light);
  const PointQuery facing{{0, 0, 3}, {0, 0, -1}};
  CHECK(importance(b, false, facing) == test::relative(light.intensity / 9).epsilon(1e-3));
  const PointQuery tilted{{4, 0, 3}, normalize(Vec3{-1, 0, 0})};
  CHECK(importance(b, false, tilted) == test::relative(light.intensity * 0.6 * 0.8 / 25).epsilon(1e-3));
  const PointQuery behind{{0, 0, -3}, {0, 0, 1}};
  CHECK(importance(b, false, behind) == 0);
  CHECK(importance(b, true, behind) > 0);
  const PointQuery below{{0, 0, 3}, {0, 0, 1}};
  CHECK(importance(b, false, below) == 0);
  CHECK(importance(b, false, {below.p, below.n, true}) == test::relative(light.intensity / 9).epsilon(1e-3));
}

TEST_CASE("importance of a wide spot does not vanish inside its cone") {
  const ClusterBounds b = ClusterBounds::from(test::spot_bounds({}, {0, 0, 1}, 0, kPi, 1));
  for (const float z : {1.0f, 0.0f, -0.5f, -0.999f}) CHECK(importance(b, false, {{std::sqrt(1 - z * z), 0, z}, {}}) > 0);
}

TEST_CASE("importance at a light without extent is 0, within a cluster it is finite") {
  const LightBounds point = test::point_bounds({1, 2, 3}, 1);
  CHECK(importance(ClusterBounds::from(point), false, {{1, 2, 3}, {}}) == 0);
  CHECK(importance(ClusterBounds::from(point), false, {{1, 2, 3.0000002f}, {}}) > 0);
  const LightBounds pair = bounds_union(point, test::point_bounds({2, 3, 4}, 1));
  CHECK(importance(ClusterBounds::from(pair), false, {pair.box.center(), {}}) == doctest::Approx(2 / (0.75 / 4)));
}

TEST_CASE("importance keeps clear of under- and overflow") {
  const ClusterBounds b = ClusterBounds::from(test::point_bounds({}, 1));
  for (const float d : {1e-45f, 1e-38f, 1e-23f, 1.0f, 2e19f, 3e38f}) {
    const double value = importance(b, false, {{d, 0, 0}, {}});
    CHECK(value == test::relative(1 / (double(d) * d)).epsilon(1e-6));
  }
}

}  // namespace
}  // namespace tyndall
