// The wide light tree at the sizes it is made for: every light within reach of u, probabilities that add up, and memory.
// More points under TYNDALL_NIGHTLY.
#include <doctest/doctest.h>

#include "light/lights.h"
#include "light/tree_selector.h"
#include "support/chi_squared.h"
#include "support/measure.h"
#include "unit/light/light_cases.h"

namespace tyndall {
namespace {

using NodeRef = WideLightTree::NodeRef;
constexpr double kByNumber = 0x1p-20;

/// The part of the range of u that belongs to a leaf, apart from what it has by its number.
struct Interval {
  double low = 0, high = 1;
};

Interval interval_of(const WideLightTree& tree, const WideQuery& q, NodeRef leaf) {
  Interval u;
  for (NodeRef ref = leaf; ref != WideLightTree::kAll; ref = tree.nodes()[ref / 8].parent) {
    const ChildImportance children = tree.children(tree.nodes()[ref / 8].parent, q);
    double before = 0, sum = 0;
    for (NodeRef i = 0; i < 8; ++i) {
      if (i < ref % 8) before += children.of[i];
      sum += children.of[i];
    }
    const double own = children.of[ref % 8];
    if (!(own > 0)) return {0, 0};
    u = {(before + u.low * own) / sum, (before + u.high * own) / sum};
  }
  return {kByNumber + (1 - kByNumber) * u.low, kByNumber + (1 - kByNumber) * u.high};
}

void check_reach(std::size_t n, const std::vector<LightBounds>& lights, std::size_t queries) {
  CAPTURE(n);
  const WideLightTree tree(test::numbered(lights));
  std::vector<NodeRef> leaves(n);
  tree.for_each_leaf([&](LightId light, NodeRef leaf) { leaves[light] = leaf; });
  for (const PointQuery& query : test::queries_for(lights, queries, 33)) {
    const WideQuery q = tree.localize(query);
    double sum = 0;
    std::size_t alive = 0, reached = 0;
    for (LightId light = 0; light < n; ++light) {
      const double pmf = tree.pmf(query, leaves[light]);
      sum += pmf;
      if (!(pmf > 0)) continue;
      ++alive;
      REQUIRE(pmf >= 0.999 * kByNumber / double(n));
      const Interval u = interval_of(tree, q, leaves[light]);
      const double width = u.high - u.low;
      REQUIRE(std::abs(width + kByNumber / double(n) - pmf) <= 1e-3 * pmf);
      if (width < 1e-12) continue;
      for (const double at : {u.low + 1e-3 * width, u.high - 1e-3 * width}) {
        const auto s = tree.select(query, at);
        REQUIRE((s && s->light == light));
      }
    }
    CHECK(sum <= 1 + 1e-5);
    // By its number every light has an interval of its own, of which the middle stands for all.
    for (std::size_t i = 0; i < n; ++i) reached += tree.select(query, kByNumber * (double(i) + 0.5) / double(n)).has_value();
    CHECK(reached == alive);
  }
}

TEST_CASE("every light that may contribute owns its probability's share of u, 30,000 lights") {
  check_reach(30'000, test::mixed_lights(30'000, 5), test::nightly() ? 60 : 12);
}

TEST_CASE("every light that may contribute owns its probability's share of u, a million lights") {
  check_reach(1'000'000, test::mixed_lights(1'000'000, 6), test::nightly() ? 12 : 1);
}

TEST_CASE("degenerate layouts: every light is within reach") {
  for (const auto& c : test::degenerate_cases(test::nightly() ? 3000 : 300)) {
    CAPTURE(c.name);
    check_reach(c.lights.size(), c.lights, 6);
  }
}

TEST_CASE("a million lights in 96 bytes each, chosen as stated; coincident ones too") {
  constexpr std::size_t kLights = 1'000'000;
  std::vector<LightBounds> coincident(kLights, test::point_bounds({1, 2, 3}, 1));
  CHECK(WideLightTree(test::numbered(coincident)).depth() <= 8);
  coincident.clear();

  const auto bounds = test::mixed_lights(kLights, 9);
  SelectionInput input;
  for (const LightBounds& b : bounds) input.power.push_back(b.intensity);
  input.near = test::numbered(bounds);
  const auto selector = make_selector(LightStrategy::tree, std::move(input));
  CHECK(double(selector->memory_bytes()) / kLights <= 96);

  // Frequencies of 64 groups of lights against the sums of their probabilities.
  for (const PointQuery& q : test::queries_for(bounds, test::nightly() ? 12 : 2, 8)) {
    constexpr std::size_t kGroups = 64;
    constexpr int kDraws = 200'000;
    std::vector<double> expected(kGroups + 1), counts(kGroups + 1);
    expected[kGroups] = kDraws;  // nothing chosen
    for (LightId id = 0; id < kLights; ++id) {
      const double e = double(selector->pmf(q, id)) * kDraws;
      expected[hash(id) % kGroups] += e;
      expected[kGroups] -= e;
    }
    Rng rng(1);
    for (int i = 0; i < kDraws; ++i) {
      const auto s = selector->select(q, rng.uniform_wide());
      counts[s ? hash(s->light) % kGroups : kGroups] += 1;
    }
    double statistic = 0;
    int bins = 0;
    for (std::size_t i = 0; i <= kGroups; ++i) {
      if (expected[i] < 5) continue;
      statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
      ++bins;
    }
    CHECK(test::chi_squared_tail(statistic, bins - 1) > 1e-4);
  }
}

}  // namespace
}  // namespace tyndall
