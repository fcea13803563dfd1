#include "light/wide_light_tree.h"

#include <doctest/doctest.h>

#include <cstring>

#include "light/split_measure.h"
#include "light_cases.h"
#include "tree_masses.h"
#include "wide_oracle.h"

namespace tyndall {
namespace {

using NodeRef = WideLightTree::NodeRef;

std::vector<NodeRef> leaves_of(const WideLightTree& tree, std::size_t lights) {
  std::vector<NodeRef> leaves(lights, WideLightTree::kAll);
  tree.for_each_leaf([&](LightId light, NodeRef leaf) {
    REQUIRE(leaves[light] == WideLightTree::kAll);
    leaves[light] = leaf;
  });
  return leaves;
}

std::vector<test::LightCase> all_cases() {
  auto cases = test::light_cases();
  for (auto& c : test::degenerate_cases()) cases.push_back(std::move(c));
  return cases;
}

TEST_CASE("every case: the tree is sound, the pmf sums to 1 less the dead mass") {
  for (const auto& c : all_cases()) {
    CAPTURE(c.name);
    const std::size_t n = c.lights.size();
    const WideLightTree tree(test::numbered(c.lights));
    const auto leaves = leaves_of(tree, n);
    for (const NodeRef leaf : leaves) REQUIRE(leaf != WideLightTree::kAll);
    REQUIRE(tree.cluster(tree.root()).count == n);
    REQUIRE(tree.depth() <= 64);
    for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
      const WideNode& node = tree.nodes()[i];
      REQUIRE(tree.node_of(node.parent) == i);
      std::uint32_t count = 0;
      for (const std::uint32_t k : node.count) count += k;
      REQUIRE(count == tree.cluster(node.parent).count);
    }
    for (const PointQuery& q : test::queries_for(c.lights, n > 1000 ? 12 : 60, 5)) test::check_pmf(tree, q, leaves);
  }
}

TEST_CASE("every case: what select() returns is what pmf() says, a million times") {
  const auto cases = all_cases();
  Rng rng(8);
  std::size_t selected = 0;
  const std::size_t each = 1'000'000 / cases.size();
  for (const auto& c : cases) {
    CAPTURE(c.name);
    const WideLightTree tree(test::numbered(c.lights));
    const auto leaves = leaves_of(tree, c.lights.size());
    const auto queries = test::queries_for(c.lights, 1000, 6);
    for (std::size_t i = 0; i < each; ++i) {
      const PointQuery& q = queries[i % queries.size()];
      const auto s = tree.select(q, i % 50 == 0 ? rng.uniform_wide() * 0x1p-20 : rng.uniform_wide());
      if (!s) continue;
      ++selected;
      REQUIRE(s->pmf > 0);
      REQUIRE(std::abs(tree.pmf(q, leaves[s->light]) - s->pmf) <= 1e-6 * s->pmf);
    }
  }
  CHECK(selected > 500'000);
}

TEST_CASE("lights are chosen with their probability") {
  for (const std::size_t n : {1u, 2u, 5u, 40u, 500u}) {
    const auto lights = test::mixed_lights(n, 77 + n);
    const WideLightTree tree(test::numbered(lights));
    for (const PointQuery& q : test::queries_for(lights, 6, 9)) {
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
  for (const auto& c : all_cases()) {
    if (c.lights.size() > 1000 || c.name.find("range") != std::string::npos || c.name.find("decades") != std::string::npos ||
        c.name.find("chain") != std::string::npos)
      continue;  // floats would not hold them
    CAPTURE(c.name);
    const WideLightTree tree(test::numbered(c.lights));
    const auto leaves = leaves_of(tree, c.lights.size());
    for (const int k : {-40, -17, 3, 40}) {
      CAPTURE(k);
      const float s = std::ldexp(1.0f, k);
      auto scaled = c.lights;
      for (LightBounds& l : scaled) l.box = {l.box.min * s, l.box.max * s};
      const WideLightTree other(test::numbered(scaled));
      const auto other_leaves = leaves_of(other, scaled.size());
      for (PointQuery q : test::queries_for(c.lights, 12, 10)) {
        std::vector<double> before;
        for (const NodeRef leaf : leaves) before.push_back(tree.pmf(q, leaf));
        q.p = q.p * s;
        for (std::size_t i = 0; i < before.size(); ++i)
          REQUIRE(std::abs(other.pmf(q, other_leaves[i]) - before[i]) <= 1e-6 * before[i]);
      }
    }
  }
}

TEST_CASE("importance of a light implies that of all clusters above it") {
  const auto lights = test::mixed_lights(20'000, 21);
  const WideLightTree tree(test::numbered(lights));
  for (const PointQuery& q : test::queries_for(lights, 12, 4)) {
    const WideQuery local = tree.localize(q);
    tree.for_each_leaf([&](LightId, NodeRef leaf) {
      if (!(tree.children(tree.nodes()[leaf / 8].parent, local).of[leaf % 8] > 0)) return;
      REQUIRE(tree.pmf(q, leaf) >= 0x1p-20 / 20'000 * 0.999);
    });
  }
}

TEST_CASE("equal input gives an equal tree for any number of threads") {
  for (const std::size_t n : {5u, 5000u, 60'000u}) {
    const auto lights = test::mixed_lights(n, 31);
    const WideLightTree a(test::numbered(lights), 1);
    for (const int threads : {0, 2, 3, 8}) {
      const WideLightTree b(test::numbered(lights), threads);
      REQUIRE(a.nodes().size() == b.nodes().size());
      CHECK(std::memcmp(a.nodes().data(), b.nodes().data(), a.nodes().size_bytes()) == 0);
    }
  }
  CHECK(WideLightTree().empty());
  CHECK(!WideLightTree().select({}, 0.5));
}

TEST_CASE("a cluster on its own: select_below() and pmf_below() belong together, clusters make up the whole") {
  const auto lights = test::mixed_lights(3000, 51);
  const WideLightTree tree(test::numbered(lights));
  const auto leaves = leaves_of(tree, lights.size());
  Rng rng(2);
  for (const PointQuery& query : test::queries_for(lights, 20, 12)) {
    const WideQuery q = tree.localize(query);
    const ChildImportance children = tree.children(tree.root(), q);
    double sum = 0;
    for (const float c : children.of) sum += c;
    for (NodeRef i = 0; i < 8; ++i) {
      if (!(children.of[i] > 0)) continue;
      for (int k = 0; k < 20; ++k) {
        const auto s = tree.select_below(i, q, rng.uniform_wide());
        if (!s) continue;
        const double below = tree.pmf_below(i, leaves[s->light], q);
        REQUIRE(std::abs(below - s->pmf) <= 1e-6 * s->pmf);
        REQUIRE(std::abs(tree.pmf(query, leaves[s->light]) - below * children.of[i] / sum) <= 1e-5 * below + 1e-8);
      }
    }
    REQUIRE(tree.select_below(leaves[5], q, 0.3)->light == 5);
    REQUIRE(tree.pmf_below(leaves[5], leaves[5], q) == 1);
  }
}

TEST_CASE("far away the choice follows power") {
  std::vector<LightBounds> lights;
  Rng rng(12);
  for (int i = 0; i < 200; ++i) lights.push_back(test::point_bounds(test::random_in_cube(rng), 1 + 9 * rng.uniform()));
  const WideLightTree tree(test::numbered(lights));
  const auto leaves = leaves_of(tree, lights.size());
  double total = 0;
  for (const auto& l : lights) total += l.intensity;
  for (const float far : {1e4f, 1e15f, 1e38f}) {
    for (std::size_t i = 0; i < lights.size(); ++i)
      CHECK(tree.pmf({{far, 0, 0}, {}}, leaves[i]) == doctest::Approx(lights[i].intensity / total).epsilon(0.03).scale(0));
  }
}

TEST_CASE("the extremes of u are safe") {
  for (const auto& c : all_cases()) {
    if (c.lights.size() > 1000) continue;
    CAPTURE(c.name);
    const WideLightTree tree(test::numbered(c.lights));
    const auto leaves = leaves_of(tree, c.lights.size());
    for (const PointQuery& q : test::queries_for(c.lights, 60, 3))
      for (const double u : {0.0, 0x1p-1074, 0x1p-60, 0x1.fffffffffffffp-21, 0x1p-20, 0.5, 0x1.fffffffffffffp-1})
        if (const auto s = tree.select(q, u)) REQUIRE(tree.pmf(q, leaves[s->light]) > 0);
  }
}

}  // namespace
}  // namespace tyndall
