#include "light/segment_importance.h"

#include <doctest/doctest.h>

#include "contribution_oracle.h"
#include "segment_cases.h"

namespace tyndall {
namespace {

/// Places along a segment from end to end, in equal angles at distance h.
std::vector<double> places(double h, double from, double till, int count) {
  std::vector<double> all;
  const double end = std::min(till, std::abs(from) + 1e9);
  const double a = std::atan(from / h), b = std::atan(end / h);
  for (int i = 0; i <= count; ++i) all.push_back(std::clamp(h * std::tan(a + (b - a) * i / count), from, end));
  return all;
}

Vec3d wide_direction(Rng& rng) { return normalize(Vec3d(test::random_direction(rng))); }

TEST_CASE("the least angle to a segment is that of the best of many points") {
  Rng rng(1);
  int inside = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3d axis = wide_direction(rng), d = wide_direction(rng);
    Vec3d aside = wide_direction(rng);
    aside = normalize(aside - d * dot(aside, d)) * std::pow(10.0, 6 * rng.uniform() - 3);
    const double from = (rng.uniform() - 0.7) * std::pow(10.0, 4 * rng.uniform() - 2);
    const double till = i % 5 == 0 ? double(kInfinity) : from + std::pow(10.0, 6 * rng.uniform() - 3);
    const double exact = largest_cosine(axis, aside, d, from, till);
    double best = -1;
    for (const double s : places(length(aside), from, till, 400)) {
      const Vec3d v = aside + d * s;
      best = std::max(best, dot(axis, v) / length(v));
    }
    REQUIRE(exact >= best - 1e-12);
    REQUIRE(exact <= best + 1e-4);
    inside += exact > std::max(dot(axis, aside + d * from) / length(aside + d * from), dot(axis, d)) + 1e-6;
  }
  CHECK(inside > 3000);
}

TEST_CASE("the least angle where the line passes through the centre, and where nothing is stationary") {
  const Vec3d d{0, 0, 1};
  CHECK(largest_cosine({0, 0, 1}, {}, d, 1, 2) == doctest::Approx(1));
  CHECK(largest_cosine({0, 0, 1}, {}, d, -2, -1) == doctest::Approx(-1));
  CHECK(largest_cosine({0, 0, 1}, {}, d, -2, 1) == doctest::Approx(1));
  CHECK(largest_cosine({1, 0, 0}, {1, 0, 0}, d, -1, 1) == doctest::Approx(1));
  CHECK(largest_cosine({1, 0, 0}, {-1, 0, 0}, d, -1, 3) == doctest::Approx(-1 / std::sqrt(10)));
  CHECK(largest_cosine({0, 0, 1}, {1, 0, 0}, d, 0, kInfinity) == doctest::Approx(1));
  CHECK(largest_cosine({0, 0, 1}, {1, 0, 0}, d, -5, 0) == doctest::Approx(0));
}

TEST_CASE("the angle of a segment is the integral of h / r^2, far and short and long") {
  const auto exact = [](long double h, long double from, long double till) {
    return std::atan2(h * (till - from), h * h + from * till);
  };
  for (const double h : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double from : {-1e6, -1.0, -1e-6, 0.0, 1e-3, 1.0, 1e6})
      for (const double span : {1e-6, 1.0, 1e6})
        REQUIRE(subtended_angle(h, from, from + span) / exact(h, from, from + span) == doctest::Approx(1).epsilon(1e-9));
  for (const auto& [h, from, till] : {std::array{1.0, -2.0, 3.0}, {0.5, 1.0, 1.5}, {2.0, -4.0, -3.5}}) {
    double sum = 0;
    for (int i = 0; i < 20'000; ++i) {
      const double s = from + (till - from) * (i + 0.5) / 20'000;
      sum += h / (h * h + s * s) * (till - from) / 20'000;
    }
    CHECK(subtended_angle(h, from, till) == doctest::Approx(sum).epsilon(1e-6));
    const double middle = middle_of_angle(h, from, till);
    CHECK(subtended_angle(h, from, middle) == doctest::Approx(sum / 2).epsilon(1e-6));
  }
  CHECK(subtended_angle(2, -1, kInfinity) == doctest::Approx(kPi / 2 + std::atan(0.5)));
  CHECK(subtended_angle(2, -1, middle_of_angle(2, -1, kInfinity)) == doctest::Approx((kPi / 2 + std::atan(0.5)) / 2));
  // Its place cancels against the ends' where the line passes the light closely.
  for (const auto& [from, till] :
       {std::pair{-0.88299346, 0.0}, {-0.7, 0.0}, {-0.3, 0.7}, {-0.1, 1e3}, {-0.3, double{kInfinity}}}) {
    const double h = 9.95e-13, whole = subtended_angle(h, from, till);
    CHECK(std::abs(subtended_angle(h, from, middle_of_angle(h, from, till)) - 0.5 * whole) < 1e-9);
  }
}

/// A light, or up to three of them, and a segment that passes near or grazes the rim of what they light.
struct Scene {
  std::array<test::ContributionOracle, 3> lights;
  int count = 0;
  LightBounds cluster;
  SegmentQuery segment;

  explicit Scene(Rng& rng) {
    count = 1 + static_cast<int>(rng.next() % 3);
    for (int k = 0; k < count; ++k) {
      do lights[k] = test::random_light(rng);
      while (!(lights[k].bounds().intensity > 0));
      if (k > 0 && rng.uniform() < 0.5f && lights[k].kind == lights[0].kind &&
          lights[k].kind == test::ContributionOracle::Kind::spot)
        lights[k].b = lights[0].b;
      cluster = bounds_union(cluster, lights[k].bounds());
    }
    PointQuery near;
    do near = test::random_query(lights[0], rng);
    while (near.p == lights[0].a);
    segment = {.o = near.p, .d = test::random_direction(rng), .t0 = 0, .t1 = std::pow(10.0f, 4 * rng.uniform() - 3)};
    if (rng.uniform() < 0.1f) segment.t1 = kInfinity;
    if (rng.uniform() < 0.3f) segment.d = normalize(segment.o - lights[0].a);
    constexpr MediaStrategy importances[] = {MediaStrategy::closest, MediaStrategy::integral, MediaStrategy::product};
    segment.importance = importances[rng.next() % 3];
    segment.profile = test::homogeneous_profile(0, segment.t1, 1, 1, 0.5f);
  }

  /// How many of some points of the segment get light from some points of the lights.
  int contributing(Rng& rng) const {
    int lit = 0;
    for (int i = 0; i < 12; ++i) {
      const float span = std::min(segment.t1, 1e3f), u = i == 0 ? 0 : i == 1 ? 1 : rng.uniform();
      PointQuery q{segment.o + segment.d * (span * (i % 2 ? u : u * u * u)), {}};
      for (int k = 0; k < count; ++k)
        for (const auto& [a, b] :
             {std::array{0.f, 0.f}, std::array{1.f, 0.f}, std::array{0.f, 1.f}, std::array{rng.uniform(), rng.uniform()}})
          lit += lights[k].contributes(q, a, b);
    }
    return lit;
  }
};

TEST_CASE("importance is 0 only where no point of the segment gets light: by brute force") {
  Rng rng(77);
  int culled = 0, contributing = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Scene scene(rng);
    const double value = importance(ClusterBounds::from(scene.cluster), scene.cluster.two_sided, scene.segment);
    REQUIRE(std::isfinite(value));
    REQUIRE(value >= 0);
    if (value > 0) continue;
    ++culled;
    contributing += scene.contributing(rng);
  }
  CHECK(contributing == 0);
  CHECK(culled > 10'000);
}

SegmentQuery segment(Vec3 o, Vec3 d, float t1, MediaStrategy importance) {
  return {.o = o, .d = d, .t0 = 0, .t1 = t1, .importance = importance, .reach = 1e30f};
}

TEST_CASE("importance of a point light: its fluence along the segment") {
  const ClusterBounds light = ClusterBounds::from(test::point_bounds({0, 3, 1}, 2));
  const auto of = [&](MediaStrategy m, float t1) { return importance(light, false, segment({}, {0, 0, 1}, t1, m)); };
  CHECK(of(MediaStrategy::closest, 4) == doctest::Approx(2.0 / 9 * 4));
  CHECK(of(MediaStrategy::integral, 4) == doctest::Approx(2 * (std::atan(1.0) + std::atan(1.0 / 3)) / 3));
  CHECK(of(MediaStrategy::integral, kInfinity) == doctest::Approx(2 * (kPi / 2 + std::atan(1.0 / 3)) / 3));
  CHECK(of(MediaStrategy::product, 4) == of(MediaStrategy::integral, 4));  // there is no profile
}

TEST_CASE("importance of a spot: the largest cosine on the segment counts, and none outside of its cone") {
  const ClusterBounds up = ClusterBounds::from(test::spot_bounds({0, 0, 0}, {0, 0, 1}, 0, kPi / 3, 1));
  const SegmentQuery across = segment({1, 0, -1}, {0, 0, 1}, 2, MediaStrategy::integral);  // up to 45 degrees
  const double full = std::atan(1.0) * 2;
  CHECK(importance(up, false, across) == doctest::Approx(full * std::sqrt(0.5)));
  SegmentQuery below = across;
  below.t1 = 1.5f;  // up to 63 degrees
  CHECK(importance(up, false, below) == 0);
  CHECK(importance(up, true, below) > 0);  // the begin is at -45 degrees
  below.importance = MediaStrategy::closest;
  CHECK(importance(up, false, below) == 0);
}

TEST_CASE("product: transmittance, scattering and phase function by fine bins") {
  // A bin as short as this is a point: the sum over them is the integral.
  constexpr int kBins = SegmentProfile::kBins;
  const Vec3 at{0.5f, 2, 1};
  const ClusterBounds light = ClusterBounds::from(test::point_bounds(at, 1));
  for (const float g : {0.0f, 0.7f, -0.6f}) {
    SegmentQuery q = segment({0, 0, 0}, normalize(Vec3{1, 0.1f, 0.2f}), 0.01f * kBins, MediaStrategy::product);
    q.profile.g = g;
    double sum = 0;
    for (int i = 0; i <= kBins; ++i) q.profile.edge[i] = 0.01f * static_cast<float>(i);
    for (int i = 0; i < kBins; ++i) {
      q.profile.scattering[i] = 1 + static_cast<float>(i);
      q.profile.sigma[i] = 0.3f;
      q.profile.escape[i] = i < kBins / 2 ? 0.1f : 1e9f;
      const double t = 0.01 * (i + 0.5);
      const Vec3d v = Vec3d(at) - Vec3d(q.d) * t;
      const double r = length(v), cosine = dot(Vec3d(q.d), v) / r;
      const double phase = (1 - g * g) / std::pow(1 + double(g) * g - 2 * g * cosine, 1.5);
      sum += 0.01 / (r * r) * (1.0 + i) / kBins * std::exp(-std::min(0.3 * r, i < kBins / 2 ? 0.1 : 1e9)) * phase;
    }
    CHECK(importance(light, false, q) == doctest::Approx(sum).epsilon(1e-3).scale(0));
  }
}

TEST_CASE("product does not vanish where the profile says that nothing arrives") {
  SegmentQuery q = segment({0, 0, 0}, {1, 0, 0}, 1, MediaStrategy::product);
  q.profile = test::homogeneous_profile(0, 1, 1e6f, kInfinity, 0.99f);
  const ClusterBounds light = ClusterBounds::from(test::point_bounds({0, 1e3f, 0}, 1));
  const double value = importance(light, false, q);
  q.importance = MediaStrategy::integral;
  CHECK(value / importance(light, false, q) / kLeastScattering == doctest::Approx(1));
}

TEST_CASE("a light on the ray: finite, and more than beside it") {
  for (const MediaStrategy m : {MediaStrategy::closest, MediaStrategy::integral, MediaStrategy::product}) {
    for (const float x : {0.0f, 0.5f, 1.0f, 2.0f, 3.0f}) {
      const SegmentQuery q = segment({0, 0, 0}, {1, 0, 0}, 2, m);
      const auto at = [&](float y) { return importance(ClusterBounds::from(test::point_bounds({x, y, 0}, 1)), false, q); };
      CHECK(std::isfinite(at(0)));
      CHECK(at(0) >= at(1e-3f));
      CHECK(at(1e-3f) > at(0.1f));
    }
  }
}

TEST_CASE("a segment that shrinks to a point has the point's importance without a normal") {
  Rng rng(5);
  for (int i = 0; i < 20'000; ++i) {
    Scene scene(rng);
    const ClusterBounds cluster = ClusterBounds::from(scene.cluster);
    scene.segment.t1 = 1e-7f;
    scene.segment.reach = 1;
    scene.segment.importance = i % 2 ? MediaStrategy::closest : MediaStrategy::integral;
    // Nearer than half the radius the integral keeps the line away, the point's rule the point.
    const double radius = 0.5 * length(Vec3d(scene.cluster.box.max) - Vec3d(scene.cluster.box.min));
    const double distance = length(Vec3d(scene.cluster.box.center()) - Vec3d(scene.segment.o));
    if (distance < 1.01 * radius || distance < 1e-3) continue;
    const double point = importance(cluster, scene.cluster.two_sided, {scene.segment.o, {}});
    const double ratio = importance(cluster, scene.cluster.two_sided, scene.segment) / double(1e-7f);
    const Vec3d to_center = Vec3d(scene.cluster.box.center()) - Vec3d(scene.segment.o);
    const double h = length(cross(to_center, Vec3d(scene.segment.d)));
    if (scene.segment.importance == MediaStrategy::integral && h < 0.5 * radius) continue;
    if (point == 0 || ratio == 0) continue;  // the segment leans to the safe side at the rim
    REQUIRE(ratio == doctest::Approx(point).epsilon(0.02).scale(0));
  }
}

TEST_CASE("nothing under- or overflows, and scaling everything by 2^k changes nothing") {
  Rng rng(9);
  for (int i = 0; i < 3000; ++i) {
    const Scene scene(rng);
    const double before = importance(ClusterBounds::from(scene.cluster), scene.cluster.two_sided, scene.segment);
    for (const int k : {-40, 40, 90}) {
      const float s = std::ldexp(1.0f, k);
      LightBounds cluster = scene.cluster;
      cluster.box = {cluster.box.min * s, cluster.box.max * s};
      SegmentQuery q = scene.segment;
      q.o = q.o * s;
      q.t1 *= s;
      q.reach *= s;
      for (float& e : q.profile.edge) e *= s;
      for (float& x : q.profile.sigma) x /= s;
      for (float& x : q.profile.scattering) x /= s;
      const double after = importance(ClusterBounds::from(cluster), cluster.two_sided, q);
      REQUIRE(std::abs(after * s - before) <= 1e-9 * before);
    }
  }
}

}  // namespace
}  // namespace tyndall
