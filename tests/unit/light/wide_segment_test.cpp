#include "light/wide_segment.h"

#include <doctest/doctest.h>

#include "contribution_oracle.h"
#include "segment_cases.h"
#include "wide_oracle.h"

namespace tyndall {
namespace {

/// Eight clusters of one to three lights, and a segment that passes near some or grazes the rim of what they light.
struct Scene {
  std::array<std::array<test::ContributionOracle, 3>, 8> lights;
  std::array<std::size_t, 8> counts{};
  WideNode node{};
  SegmentQuery segment;

  explicit Scene(Rng& rng) {
    std::array<Cluster, 8> clusters;
    for (std::size_t k = 0; k < 8; ++k) {
      std::array<Cluster, 3> parts;
      for (std::size_t wanted = 1 + rng.next() % 3; counts[k] < wanted;) {
        test::ContributionOracle& l = lights[k][counts[k]] = test::random_light(rng);
        if (counts[k] > 0 && rng.uniform() < 0.5f && l.kind == lights[k][0].kind) l.b = lights[k][0].b;
        LightBounds b = l.bounds();
        if (!(b.intensity > 0)) continue;
        b.intensity = 0.1f + rng.uniform();
        parts[counts[k]++] = cluster_of(b);
      }
      clusters[k] = cluster_union(std::span(parts).first(counts[k]));
    }
    node.set_children(clusters, std::array<std::uint32_t, 8>{});
    const auto& near = lights[rng.next() % 8][0];
    segment = {.o = test::random_query(near, rng).p,
               .d = test::random_direction(rng),
               .t0 = 0,
               .t1 = std::pow(10.0f, 4 * rng.uniform() - 3)};
    if (rng.uniform() < 0.1f) segment.t1 = kInfinity;
    if (rng.uniform() < 0.3f && !(segment.o == near.a)) segment.d = normalize(segment.o - near.a);
    if (rng.uniform() < 0.2f) segment.o = segment.o - segment.d * (100 * rng.uniform()), segment.t1 += 100;
    constexpr MediaStrategy importances[] = {MediaStrategy::closest, MediaStrategy::integral, MediaStrategy::product};
    segment.importance = importances[rng.next() % 3];
    const float g = rng.uniform() < 0.3f ? 0 : 1.9f * rng.uniform() - 0.95f;
    segment.profile = test::homogeneous_profile(0, segment.t1, std::exp(6 * rng.uniform() - 3), 1 + rng.uniform(), g);
  }
  WideSegment local() const { return WideSegment::from_segment(segment, 1, {}); }
};

TEST_CASE("wide segments: importance is 0 only where no point of the segment gets light, by brute force") {
  Rng rng(2026);
  int contributing = 0, culled = 0;
  for (int i = 0; i < 60'000; ++i) {
    const Scene scene(rng);
    const ChildImportance importance = child_importance(scene.node, scene.local());
    for (std::size_t k = 0; k < 8; ++k) {
      REQUIRE(std::isfinite(importance.of[k]));
      if (importance.of[k] > 0) continue;
      ++culled;
      const SegmentQuery& s = scene.segment;
      for (int j = 0; j < 12; ++j) {
        const float span = std::min(s.t1, 1e3f), u = j == 0 ? 0 : j == 1 ? 1 : rng.uniform();
        const PointQuery q{s.o + s.d * (span * (j % 2 ? u : u * u * u)), {}};
        for (std::size_t l = 0; l < scene.counts[k]; ++l)
          for (const auto& [a, b] :
               {std::array{0.f, 0.f}, std::array{1.f, 0.f}, std::array{0.f, 1.f}, std::array{rng.uniform(), rng.uniform()}})
            contributing += scene.lights[k][l].contributes(q, a, b);
      }
    }
  }
  CHECK(contributing == 0);
  CHECK(culled > 20'000);
}

TEST_CASE("wide segments: eight at once give what one at a time in double precision gives") {
  Rng rng(7);
  int compared = 0, none = 0, within_rounding = 0;
  for (int i = 0; i < 30'000; ++i) {
    const Scene scene(rng);
    const WideSegment s = scene.local();
    const ChildImportance wide = child_importance(scene.node, s);
    for (std::size_t k = 0; k < 8; ++k) {
      const auto one = test::oracle_importance(scene.node.cluster(static_cast<int>(k)), s);
      const double value = double(wide.of[k]) * scene.node.scale;
      if (one.margin < 1e-3) continue;  // the wide one leans to the safe side there
      CAPTURE(int(s.importance));
      CAPTURE(k);
      CAPTURE(one.upper);
      REQUIRE((value > 0) == (one.value > 0));
      REQUIRE(std::abs(value - one.value) <= 1e-2 * (one.upper + one.value));  // rims and peaks magnify rounding
      within_rounding += std::abs(value - one.value) <= 1e-4 * one.value;
      one.value > 0 ? ++compared : ++none;
    }
  }
  CHECK(compared > 50'000);
  CHECK(within_rounding > 0.99 * (compared + none));
  CHECK(none > 10'000);
}

TEST_CASE("wide segments: lights on the line, huge offsets and unbounded spans give finite weights") {
  Rng rng(3);
  for (int i = 0; i < 20'000; ++i) {
    Scene scene(rng);
    SegmentQuery& s = scene.segment;
    const float offset = std::pow(10.0f, 60 * rng.uniform() - 30);
    switch (i % 4) {
      case 0:
        s.d = normalize(scene.lights[0][0].a - s.o);
        break;
      case 1:
        s.o = s.o - s.d * offset;
        s.t0 = offset;
        s.t1 = i % 8 == 1 ? kInfinity : 2 * offset;
        break;
      case 2:
        s.o = s.o + test::random_direction(rng) * offset;
        break;
      default:
        s.t1 = offset;
        break;
    }
    if (!(s.t1 > s.t0)) s.t1 = std::nextafter(s.t0, kInfinity);
    s.profile = test::homogeneous_profile(s.t0, s.t1, 1, 1, 0.9f);
    for (const float value : child_importance(scene.node, scene.local()).of) {
      REQUIRE(std::isfinite(value));
      REQUIRE((value == 0 || value >= 1e-37f));
    }
  }
}

TEST_CASE("wide segments: an unbounded span is the limit of long ones") {
  Rng rng(13);
  for (int i = 0; i < 5000; ++i) {
    Scene scene(rng);
    scene.segment.t0 = i % 2 ? 0 : 100;
    const auto weights = [&](float t1) {
      scene.segment.t1 = t1;
      auto& edge = scene.segment.profile.edge;
      edge.fill(t1);
      std::copy_n(std::array{scene.segment.t0, 200.0f, 300.0f}.begin(), 3, edge.begin());
      const WideSegment local = scene.local();
      ChildImportance importance = child_importance(scene.node, local);
      for (float& w : importance.of) w *= static_cast<float>(local.to_world);
      return importance;
    };
    const ChildImportance longer = weights(1e7f), unbounded = weights(kInfinity);
    for (std::size_t k = 0; k < 8; ++k) {
      if (!(longer.of[k] > 1e-20f)) continue;
      REQUIRE(unbounded.of[k] / longer.of[k] == doctest::Approx(1).epsilon(0.01));
    }
  }
}

}  // namespace
}  // namespace tyndall
