#include "light/wide_node.h"

#include <doctest/doctest.h>

#include "contribution_oracle.h"
#include "support/relative.h"
#include "wide_oracle.h"

namespace tyndall {
namespace {

constexpr std::array<std::uint32_t, 8> kNoChildren{};

WideQuery local(const PointQuery& q) { return {q.p, q.n, dot(q.n, q.n) > 0, q.transmissive}; }

TEST_CASE("what is stored of a cluster holds it") {
  Rng rng(5);
  for (int i = 0; i < 20'000; ++i) {
    std::array<Cluster, 3> parts;
    for (Cluster& c : parts) {
      LightBounds b = test::random_light(rng).bounds();
      b.intensity = std::pow(10.0f, 20 * rng.uniform() - 10);
      c = cluster_of(b);
    }
    const std::array<Cluster, 2> clusters{parts[0], cluster_union(parts)};
    WideNode node{};
    node.set_children(clusters, std::array<std::uint32_t, 2>{1, 2});
    for (int k = 0; k < 2; ++k) {
      const Cluster &is = clusters[k], stored = node.cluster(k);
      REQUIRE(stored.box.contains(is.box.min));
      REQUIRE(stored.box.contains(is.box.max));
      for (int axis = 0; axis < 3; ++axis) REQUIRE(stored.box.extent()[axis] <= 1.01f * is.box.extent()[axis] + 1e-6f);
      if (!stored.normals.full())
        REQUIRE(stored.normals.theta >= is.normals.theta + angle_between(stored.normals.axis, is.normals.axis) - 5e-6f);
      REQUIRE(stored.theta_e >= is.theta_e - 1e-6f);
      REQUIRE(stored.theta_e <= is.theta_e + 0.02f);
      REQUIRE(stored.count == is.count);
      REQUIRE(stored.two_sided == is.two_sided);
      REQUIRE(stored.intensity >= is.intensity * 0.995);
      REQUIRE(std::sqrt(stored.variance) == test::relative(std::sqrt(is.variance)).epsilon(0.005));
      REQUIRE(length(stored.mean - is.mean) <= 0.01 * length(is.box.extent()) + 1e-7);
    }
    CHECK(node.leaf(0));
    CHECK(!node.leaf(1));
    CHECK(!node.used(2));
  }
}

TEST_CASE("moments of a union are those of its lights") {
  const LightBounds a = test::point_bounds({0, 0, 0}, 1), b = test::point_bounds({4, 0, 0}, 3),
                    c = test::point_bounds({0, 2, 0}, 4);
  const std::array<Cluster, 2> ab{cluster_of(a), cluster_of(b)};
  const std::array<Cluster, 2> all{cluster_union(ab), cluster_of(c)};
  const Cluster u = cluster_union(all);
  CHECK(u.count == 3);
  CHECK(u.intensity == 8);
  CHECK(u.mean.x == doctest::Approx(1.5));
  CHECK(u.mean.y == doctest::Approx(1));
  CHECK(u.variance == doctest::Approx((1 * (2.25 + 1) + 3 * (6.25 + 1) + 4 * (2.25 + 1)) / 8));
  CHECK(u.intensity_cv2() == doctest::Approx(3.0 * (1 + 9 + 16) / 64 - 1));
}

TEST_CASE("importance is 0 only where nothing can contribute: a million clusters, points and normals by brute force") {
  Rng rng(2025);
  int contributing = 0, culled = 0;
  for (int i = 0; i < 125'000; ++i) {
    std::array<std::array<test::ContributionOracle, 3>, 8> lights;
    std::array<std::size_t, 8> counts;
    std::array<Cluster, 8> clusters;
    for (std::size_t k = 0; k < 8; ++k) {
      std::array<Cluster, 3> parts;
      counts[k] = 0;
      for (std::size_t wanted = 1 + rng.next() % 3; counts[k] < wanted;) {
        test::ContributionOracle& l = lights[k][counts[k]] = test::random_light(rng);
        if (counts[k] > 0 && rng.uniform() < 0.5f && l.kind == lights[k][0].kind) l.b = lights[k][0].b;
        if (l.bounds().intensity > 0) parts[counts[k]++] = cluster_of(l.bounds());
      }
      clusters[k] = cluster_union(std::span(parts).first(counts[k]));
    }
    WideNode node{};
    node.set_children(clusters, kNoChildren);
    const PointQuery q = test::random_query(lights[rng.next() % 8][0], rng);
    const ChildImportance importance = child_importance(node, local(q));
    for (std::size_t k = 0; k < 8; ++k) {
      REQUIRE(std::isfinite(importance.of[k]));
      if (importance.of[k] > 0) continue;
      ++culled;
      for (std::size_t l = 0; l < counts[k]; ++l) {
        for (const auto& [u, v] : {std::array{0.f, 0.f}, std::array{1.f, 0.f}, std::array{0.f, 1.f},
                                   std::array{rng.uniform(), rng.uniform()}, std::array{rng.uniform(), rng.uniform()}})
          if (lights[k][l].contributes(q, u, v)) ++contributing;
      }
    }
  }
  CHECK(contributing == 0);
  CHECK(culled > 100'000);  // the test must mean something
}

TEST_CASE("eight at once give what one at a time in double precision gives") {
  Rng rng(7);
  int compared = 0, none = 0, within_rounding = 0;
  for (int i = 0; i < 40'000; ++i) {
    std::array<Cluster, 8> clusters;
    const std::size_t size = 1 + rng.next() % 8;
    test::ContributionOracle last;
    for (std::size_t k = 0; k < size; ++k) {
      std::array<Cluster, 2> parts;
      for (Cluster& c : parts) {
        last = test::random_light(rng);
        LightBounds b = last.bounds();
        b.intensity = 0.1f + rng.uniform();
        c = cluster_of(b);
      }
      clusters[k] = cluster_union(std::span(parts).first(1 + rng.next() % 2));
    }
    WideNode node{};
    node.set_children(std::span(clusters).first(size), std::span(kNoChildren).first(size));
    const WideQuery q = local(test::random_query(last, rng));
    const ChildImportance wide = child_importance(node, q);
    for (std::size_t k = 0; k < 8; ++k) {
      if (k >= size) {
        REQUIRE(wide.of[k] == 0);
        continue;
      }
      const auto one = test::oracle_importance(node.cluster(static_cast<int>(k)), q);
      const double value = double(wide.of[k]) * node.scale;
      if (one.margin < 1e-3) continue;  // the wide one leans to the safe side there
      REQUIRE((value > 0) == (one.value > 0));
      REQUIRE(std::abs(value - one.value) <= 2e-3 * one.upper);  // right behind the light its sine is rounded up
      within_rounding += std::abs(value - one.value) <= 1e-5 * one.upper;
      one.value > 0 ? ++compared : ++none;
    }
  }
  CHECK(compared > 50'000);
  CHECK(within_rounding > 0.99 * (compared + none));
  CHECK(none > 10'000);
}

/// A lobe such as Vertex makes them, of random shape.
QueryLobe random_lobe(Vec3 n, Rng& rng) {
  QueryLobe lobe;
  const Vec3 across = normalize(cross(n, test::random_direction(rng)));
  lobe.tangent = across;
  lobe.bitangent = cross(n, across);
  lobe.cos_o = 0.05f + 0.9f * rng.uniform();
  lobe.sin_o = std::sqrt(1 - lobe.cos_o * lobe.cos_o);
  lobe.eta = rng.uniform() < 0.5f ? 1 : 0.6f + rng.uniform();
  lobe.slope2_t = std::pow(10.0f, -3 * rng.uniform());
  lobe.slope2_b = std::pow(10.0f, -3 * rng.uniform());
  lobe.spread_t = 0.25f;
  lobe.spread_b = 0.25f / (lobe.cos_o * lobe.cos_o);
  lobe.scale = 0.1f + rng.uniform();
  return lobe;
}

TEST_CASE("lobes and phase functions, eight at once, give what one at a time in double precision gives") {
  Rng rng(17);
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::array<Cluster, 8> clusters;
    for (Cluster& c : clusters) {
      std::array<Cluster, 2> parts;
      for (Cluster& part : parts) {
        LightBounds b = test::random_light(rng).bounds();
        b.intensity = 0.1f + rng.uniform();
        part = cluster_of(b);
      }
      c = cluster_union(std::span(parts).first(1 + rng.next() % 2));
    }
    WideNode node{};
    node.set_children(clusters, kNoChildren);
    WideQuery q{test::random_in_cube(rng, 3), test::random_direction(rng), i % 3 != 0, rng.uniform() < 0.5f};
    q.g = 1.9f * rng.uniform() - 0.95f;
    q.forward = test::random_direction(rng);
    q.diffuse = rng.uniform();
    q.lobe_count = 1 + static_cast<int>(rng.next() % 2);
    for (QueryLobe& lobe : q.lobes) lobe = random_lobe(q.n, rng);
    const ChildImportance wide = child_importance(node, q);
    for (std::size_t k = 0; k < 8; ++k) {
      const auto one = test::oracle_importance(node.cluster(static_cast<int>(k)), q);
      const double value = double(wide.of[k]) * node.scale;
      if (one.margin < 1e-3) continue;
      REQUIRE((value > 0) == (one.value > 0));
      REQUIRE(std::abs(value - one.value) <= 5e-3 * std::max(one.value, one.upper));
      ++compared;
    }
  }
  CHECK(compared > 100'000);
}

}  // namespace
}  // namespace tyndall
