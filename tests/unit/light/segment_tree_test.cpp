// Choice of a light for a segment of a ray, by both trees.
#include <doctest/doctest.h>

#include "light/wide_light_tree.h"
#include "segment_cases.h"
#include "tree_masses.h"

namespace tyndall {
namespace {

/// The leaf of every light.
template <typename Tree>
std::vector<std::uint32_t> leaves_of(const Tree& tree, std::size_t lights) {
  std::vector<std::uint32_t> leaves(lights);
  tree.for_each_leaf([&](LightId light, std::uint32_t leaf) { leaves[light] = leaf; });
  return leaves;
}

struct AveragedTree : LightTree {
  explicit AveragedTree(std::vector<TreeLight> lights) : LightTree(std::move(lights), ChildRule::averaged) {}
};

std::vector<test::LightCase> all_cases() {
  auto cases = test::light_cases();
  for (auto& c : test::degenerate_cases(60)) cases.push_back(std::move(c));
  return cases;
}

TEST_CASE_TEMPLATE("segments: the pmf sums to 1 less the dead mass", Tree, LightTree, AveragedTree, WideLightTree) {
  for (const auto& c : all_cases()) {
    CAPTURE(c.name);
    const std::size_t n = c.lights.size();
    const Tree tree(test::numbered(c.lights));
    const auto leaves = leaves_of(tree, n);
    for (const SegmentQuery& q : test::segments_for(c.lights, n > 1000 ? 9 : 54, 5)) test::check_pmf(tree, q, leaves);
  }
}

TEST_CASE_TEMPLATE("segments: what select() returns is what pmf() says", Tree, LightTree, AveragedTree, WideLightTree) {
  const auto cases = all_cases();
  Rng rng(8);
  std::size_t selected = 0;
  for (const auto& c : cases) {
    CAPTURE(c.name);
    const Tree tree(test::numbered(c.lights));
    const auto leaves = leaves_of(tree, c.lights.size());
    for (const SegmentQuery& q : test::segments_for(c.lights, 300, 6)) {
      for (int i = 0; i < 5; ++i) {
        const auto s = tree.select(q, i == 0 ? rng.uniform_wide() * 0x1p-20 : rng.uniform_wide());
        if (!s) continue;
        ++selected;
        REQUIRE(s->pmf > 0);
        REQUIRE(std::abs(tree.pmf(q, leaves[s->light]) - s->pmf) <= 1e-6 * s->pmf);
      }
    }
  }
  CHECK(selected > 50'000);
}

TEST_CASE_TEMPLATE("segments: lights are chosen with their probability", Tree, LightTree, AveragedTree, WideLightTree) {
  for (const std::size_t n : {1u, 2u, 5u, 40u, 500u, 100'000u}) {
    const auto lights = test::mixed_lights(n, 77 + n);
    const Tree tree(test::numbered(lights));
    for (const SegmentQuery& q : test::segments_for(lights, n > 1000 ? 5 : 27, 9)) {
      constexpr int kDraws = 20'000;
      std::vector<double> counts(n + 1);
      Rng rng(n);
      for (int i = 0; i < kDraws; ++i) {
        const auto s = tree.select(q, (i + rng.uniform_wide()) / kDraws);
        counts[s ? s->light : n] += 1;
      }
      CHECK(test::p_value_of(counts, test::walk(tree, q, n), kDraws) > 1e-5);
    }
  }
}

SegmentQuery scaled(SegmentQuery q, float s) {
  q.o = q.o * s;
  q.t0 *= s;
  q.t1 *= s;
  q.reach *= s;
  for (float& e : q.profile.edge) e *= s;
  for (float& x : q.profile.sigma) x /= s;
  for (float& x : q.profile.scattering) x /= s;
  return q;
}

TEST_CASE_TEMPLATE("segments: scaling the scene by powers of two changes no probability", Tree, LightTree, WideLightTree) {
  for (const auto& c : all_cases()) {
    if (c.lights.size() > 1000 || c.name.find("range") != std::string::npos || c.name.find("decades") != std::string::npos ||
        c.name.find("chain") != std::string::npos)
      continue;  // floats would not hold them
    CAPTURE(c.name);
    const Tree tree(test::numbered(c.lights));
    const auto leaves = leaves_of(tree, c.lights.size());
    for (const int k : {-40, 3, 40}) {
      CAPTURE(k);
      const float s = std::ldexp(1.0f, k);
      auto lights = c.lights;
      for (LightBounds& l : lights) l.box = {l.box.min * s, l.box.max * s};
      const Tree other(test::numbered(lights));
      const auto other_leaves = leaves_of(other, lights.size());
      for (const SegmentQuery& q : test::segments_for(c.lights, 27, 10)) {
        const SegmentQuery other_query = scaled(q, s);
        for (std::size_t i = 0; i < leaves.size(); ++i) {
          const double before = tree.pmf(q, leaves[i]);
          REQUIRE(std::abs(other.pmf(other_query, other_leaves[i]) - before) <= 1e-6 * before);
        }
      }
    }
  }
}

TEST_CASE_TEMPLATE("segments: the importance of all lights is what they send, in W/sr / length", Tree, LightTree,
                   WideLightTree) {
  // Far from all lights it is that of one light with their power; and so at any scale.
  Rng rng(3);
  std::vector<LightBounds> lights;
  for (int i = 0; i < 100; ++i) lights.push_back(test::point_bounds(test::random_in_cube(rng, 0.1f), 2));
  const Tree tree(test::numbered(lights));
  for (const float distance : {1e2f, 1e5f, 1e9f}) {
    SegmentQuery q{.o = {0, 0, distance}, .d = {1, 0, 0}, .t0 = 0, .t1 = distance, .reach = 3 * distance};
    const double L = distance;
    for (const auto& [m, expected] : {std::pair{MediaStrategy::closest, 200 / (L * L) * L},
                                      std::pair{MediaStrategy::integral, 200 * double(kPi) / 4 / L}}) {
      q.importance = m;
      CHECK(tree.importance(q) / expected == doctest::Approx(1).epsilon(0.01));
    }
    q.importance = MediaStrategy::product;
    CHECK(tree.importance(q) * L == doctest::Approx(200 * double(kPi) / 4).epsilon(0.01));
    q.profile = test::homogeneous_profile(0, distance, 1 / distance, 0.5f * distance, 0);
    // int exp(-t) exp(-0.5) / (1 + t^2) dt, relative to the first bin's scattering
    double sum = 0;
    for (int i = 0; i < 1000; ++i) sum += std::exp(-(i + 0.5) / 1000 - 0.5) / (1 + std::pow((i + 0.5) / 1000, 2)) / 1000;
    CHECK(tree.importance(q) * L == doctest::Approx(200 * sum / (q.profile.scattering[0] * L)).epsilon(0.02));
  }
}

TEST_CASE_TEMPLATE("segments: one that shrinks to a point asks what the point asks", Tree, LightTree, WideLightTree) {
  std::vector<LightBounds> lights;
  Rng rng(12);
  for (int i = 0; i < 300; ++i) lights.push_back(test::point_bounds(test::random_in_cube(rng), 1 + 9 * rng.uniform()));
  const Tree tree(test::numbered(lights));
  const auto leaves = leaves_of(tree, lights.size());
  for (int k = 0; k < 30; ++k) {
    SegmentQuery q{.o = test::random_direction(rng) * 3.0f, .d = test::random_direction(rng), .t0 = 0, .t1 = 1e-5f};
    q.importance = k % 2 ? MediaStrategy::closest : MediaStrategy::integral;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      // Outside the clusters only the share of their variance that counts as distance differs, by a few percent.
      const double point = tree.pmf(PointQuery{q.o, {}}, leaves[i]);
      REQUIRE(tree.pmf(q, leaves[i]) == doctest::Approx(point).epsilon(0.1).scale(0));
    }
  }
}

TEST_CASE_TEMPLATE("segments: from how far the ray comes does not matter", Tree, LightTree, WideLightTree) {
  std::vector<LightBounds> lights;
  Rng rng(14);
  for (int i = 0; i < 300; ++i) lights.push_back(test::point_bounds(test::random_in_cube(rng), 1 + 9 * rng.uniform()));
  const Tree tree(test::numbered(lights));
  const auto leaves = leaves_of(tree, lights.size());
  for (const float y : {0.0f, 0.25f, 3.0f}) {
    for (const MediaStrategy m : {MediaStrategy::closest, MediaStrategy::integral, MediaStrategy::product}) {
      SegmentQuery near{.o = {-2, y, 0.5f}, .d = {1, 0, 0}, .t0 = 0, .t1 = 4, .importance = m}, far = near;
      constexpr float kFar = 0x1p20;  // a quarter is what floats resolve there
      far.o.x -= kFar;
      far.t0 += kFar;
      far.t1 += kFar;
      near.profile = far.profile = test::homogeneous_profile(0, 4, 1, 1, 0.5f);
      for (float& e : far.profile.edge) e += kFar;
      near.profile.edge = far.profile.edge;
      for (float& e : near.profile.edge) e -= kFar;
      for (const auto leaf : leaves)
        REQUIRE(tree.pmf(far, leaf) == doctest::Approx(tree.pmf(near, leaf)).epsilon(1e-4).scale(0));
    }
  }
}

TEST_CASE_TEMPLATE("segments: a light that can contribute is within reach of u", Tree, LightTree, AveragedTree, WideLightTree) {
  const auto lights = test::mixed_lights(20'000, 21);
  const Tree tree(test::numbered(lights));
  const auto leaves = leaves_of(tree, lights.size());
  for (const SegmentQuery& q : test::segments_for(lights, 9, 4)) {
    const Segment segment(q);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      // The wide tree's own bounds are wider still.
      if (!(importance(ClusterBounds::from(lights[i]), lights[i].two_sided, segment) > 0)) continue;
      REQUIRE(tree.pmf(segment, leaves[i]) > 0);
    }
  }
}

}  // namespace
}  // namespace tyndall
