#include "light/light_tree.h"

#include <doctest/doctest.h>

#include <cstring>

#include "light_cases.h"
#include "tree_masses.h"

namespace tyndall {
namespace {

/// Leaf of every light.
std::vector<std::uint32_t> leaves_of(const LightTree& tree, std::size_t lights) {
  std::vector<std::uint32_t> leaves(lights, LightTree::kNoParent);
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i)
    if (tree.nodes()[i].leaf) leaves[tree.nodes()[i].second_or_light] = i;
  return leaves;
}

constexpr ChildRule kRules[] = {ChildRule::proportional, ChildRule::averaged};

void check_tree(const test::LightCase& c, ChildRule rule) {
  const LightTree tree(test::numbered(c.lights), rule);
  const std::size_t n = c.lights.size();
  REQUIRE(tree.nodes().size() == 2 * n - 1);
  const auto leaves = leaves_of(tree, n);
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    const auto& node = tree.nodes()[i];
    REQUIRE((node.parent == LightTree::kNoParent) == (i == 0));
    if (node.leaf) continue;
    REQUIRE(tree.nodes()[i + 1].parent == i);
    REQUIRE(tree.nodes()[node.second_or_light].parent == i);
  }
  for (const std::uint32_t leaf : leaves) REQUIRE(leaf != LightTree::kNoParent);

  for (const PointQuery& q : test::queries_for(c.lights, n > 1000 ? 12 : 60, 5)) {
    test::check_pmf(tree, q, leaves);
  }
}

TEST_CASE("every case: the tree is sound, the pmf sums to 1 less the dead mass") {
  for (const auto& c : test::light_cases()) {
    CAPTURE(c.name);
    for (const ChildRule rule : kRules) check_tree(c, rule);
  }
}

TEST_CASE("every case: what select() returns is what pmf() says, a million times") {
  const auto cases = test::light_cases();
  Rng rng(8);
  std::size_t selected = 0;
  const std::size_t each = 1'000'000 / cases.size();
  for (const auto& c : cases) {
    CAPTURE(c.name);
    const LightTree trees[] = {LightTree(test::numbered(c.lights), kRules[0]), LightTree(test::numbered(c.lights), kRules[1])};
    const auto leaves = leaves_of(trees[0], c.lights.size());
    const auto queries = test::queries_for(c.lights, 1000, 6);
    for (std::size_t i = 0; i < each; ++i) {
      const LightTree& tree = trees[i % 2];
      const PointQuery& q = queries[i % queries.size()];
      const auto s = tree.select(q, rng.uniform_wide());
      if (!s) continue;
      ++selected;
      REQUIRE(s->pmf > 0);
      REQUIRE(std::abs(tree.pmf(q, leaves[s->light]) - s->pmf) <= 1e-6 * s->pmf);
    }
  }
  CHECK(selected > 500'000);
}

TEST_CASE("lights are chosen with their probability") {
  for (const std::size_t n : {2u, 5u, 40u, 500u}) {
    const auto lights = test::mixed_lights(n, 77 + n);
    const LightTree trees[] = {LightTree(test::numbered(lights), kRules[0]), LightTree(test::numbered(lights), kRules[1])};
    const auto queries = test::queries_for(lights, 12, 9);
    for (std::size_t k = 0; k < queries.size(); ++k) {
      const PointQuery& q = queries[k];
      const LightTree& tree = trees[k / 6];
      constexpr int kDraws = 40'000;
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

TEST_CASE("scaling the scene by powers of two changes no probability") {
  for (const auto& c : test::light_cases()) {
    if (c.lights.size() > 1000 || c.name.find("range") != std::string::npos || c.name.find("decades") != std::string::npos)
      continue;
    CAPTURE(c.name);
    const LightTree tree(test::numbered(c.lights));
    const auto leaves = leaves_of(tree, c.lights.size());
    const auto queries = test::queries_for(c.lights, 12, 10);
    for (const int k : {-40, -17, 3, 40}) {
      CAPTURE(k);
      const float s = std::ldexp(1.0f, k);
      auto scaled = c.lights;
      for (LightBounds& l : scaled) l.box = {l.box.min * s, l.box.max * s};
      const LightTree other(test::numbered(scaled));
      const auto other_leaves = leaves_of(other, scaled.size());
      for (PointQuery q : queries) {
        std::vector<double> before;
        for (const auto leaf : leaves) before.push_back(tree.pmf(q, leaf));
        q.p = q.p * s;
        for (std::size_t i = 0; i < before.size(); ++i)
          REQUIRE(std::abs(other.pmf(q, other_leaves[i]) - before[i]) <= 1e-4 * before[i] + 1e-12);
      }
    }
  }
}

TEST_CASE("a light that can contribute is always reachable") {
  // Of 100,000 lights, those whose probability is less than a step of u are a negligible part of all.
  const auto lights = test::mixed_lights(100'000, 21);
  const LightTree tree(test::numbered(lights));
  const PointQuery q{{0.1f, 0.2f, -0.3f}, {}};
  double unreachable = 0;
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    const auto& node = tree.nodes()[i];
    if (!node.leaf || !(importance(node.bounds, node.two_sided, q) > 0)) continue;
    bool alive = true;
    for (std::uint32_t p = node.parent; p != LightTree::kNoParent && alive; p = tree.nodes()[p].parent)
      alive = importance(tree.nodes()[p].bounds, tree.nodes()[p].two_sided, q) > 0;
    REQUIRE(alive);  // bounds nest: importance of a leaf implies that of all above it
    const double pmf = tree.pmf(q, i);
    REQUIRE(pmf > 0);
    if (pmf < 0x1p-52) unreachable += pmf;
  }
  CHECK(unreachable < 1e-13);
}

TEST_CASE("the averaged rule: half of each share where the lower bounds say nothing, and no share without importance") {
  std::vector<LightBounds> points{test::point_bounds({-1, 0, 0}, 1), test::point_bounds({1, 0, 0}, 3)};
  const LightTree tree(test::numbered(points)), averaged(test::numbered(points), ChildRule::averaged);
  for (const PointQuery& q : test::queries_for(points, 60, 2)) {
    const auto p = tree.child_probability(0, q), other = averaged.child_probability(0, q);
    REQUIRE(p.has_value() == other.has_value());
    if (!p) continue;
    CHECK(*other == doctest::Approx(*p == 0 || *p == 1 ? *p : 0.5 * *p + 0.25));
  }
  const Segment along({.o = {-3, 0.5f, 0}, .d = {1, 0, 0}, .t0 = 0, .t1 = 3, .importance = MediaStrategy::integral});
  CHECK(*averaged.child_probability(0, along) == doctest::Approx(0.5 * *tree.child_probability(0, along) + 0.25));

  // Small triangles that face a surface: their bounds nearly meet, and the shares are those of both.
  std::vector<LightBounds> faces;
  for (const float x : {-1.0f, 1.0f})
    faces.push_back(test::triangle_bounds({x, 0, 5}, {x, 1e-3f, 5}, {x + 1e-3f, 0, 5}, false, x > 0 ? 3 : 1));
  const LightTree tight(test::numbered(faces)), both(test::numbered(faces), ChildRule::averaged);
  const PointQuery floor{{0.3f, 0, 0}, {0, 0, 1}};
  CHECK(*both.child_probability(0, floor) == doctest::Approx(*tight.child_probability(0, floor)).epsilon(1e-3));
}

TEST_CASE("far away the choice follows power") {
  const auto lights = [] {
    std::vector<LightBounds> l;
    Rng rng(12);
    for (int i = 0; i < 200; ++i) l.push_back(test::point_bounds(test::random_in_cube(rng), 1 + 9 * rng.uniform()));
    return l;
  }();
  const LightTree tree(test::numbered(lights));
  const auto leaves = leaves_of(tree, lights.size());
  double total = 0;
  for (const auto& l : lights) total += l.intensity;
  for (std::size_t i = 0; i < lights.size(); ++i)
    CHECK(tree.pmf({{1e4f, 0, 0}, {}}, leaves[i]) == doctest::Approx(lights[i].intensity / total).epsilon(0.01).scale(0));
}

TEST_CASE("equal input gives an equal tree, and depth stays moderate") {
  const auto lights = test::mixed_lights(5000, 31);
  const LightTree a(test::numbered(lights)), b(test::numbered(lights));
  CHECK(std::memcmp(a.nodes().data(), b.nodes().data(), a.nodes().size_bytes()) == 0);
  CHECK(a.depth() <= 40);
  const LightTree coincident(test::numbered(std::vector(4096, test::point_bounds({1, 1, 1}, 1))));
  CHECK(coincident.depth() == 12);
  CHECK(LightTree().empty());
  CHECK(!LightTree().select({}, 0.5));
}

TEST_CASE("the extremes of u are safe") {
  const auto lights = test::mixed_lights(1000, 41);
  const LightTree tree(test::numbered(lights));
  const auto leaves = leaves_of(tree, lights.size());
  for (const PointQuery& q : test::queries_for(lights, 200, 3))
    for (const double u : {0.0, 0x1p-1074, 0x1p-60, 0.5, 0x1.fffffffffffffp-1})
      if (const auto s = tree.select(q, u)) CHECK(tree.pmf(q, leaves[s->light]) > 0);
}

}  // namespace
}  // namespace tyndall
