#include <doctest/doctest.h>

#include <algorithm>

#include "light/lightcuts_selector.h"
#include "light/tree_cut.h"
#include "segment_cases.h"
#include "support/chi_squared.h"
#include "support/relative.h"

namespace tyndall {
namespace {

std::vector<LightBounds> unit_box() { return {test::point_bounds({-1, -1, -1}, 1), test::point_bounds({1, 1, 1}, 1)}; }
std::vector<PointQuery> points() { return test::queries_for(unit_box(), 30, 9); }
std::vector<SegmentQuery> segments() { return test::segments_for(unit_box(), 27, 9); }

std::unique_ptr<const LightSelector> lightcuts(SelectionInput input) {
  return make_selector(LightStrategy::lightcuts, std::move(input));
}

/// The cut by its definition: all nodes are looked at in every round.
std::vector<std::uint32_t> cut_by_definition(const LightTree& tree, const CutGoal& goal, const auto& measure) {
  std::vector<std::uint32_t> cut{0};
  const auto error = [&](std::uint32_t node) { return tree.nodes()[node].leaf ? 0 : measure(node).bound; };
  while (!cut.empty() && cut.size() < goal.nodes) {
    double total = goal.beside;
    for (const std::uint32_t node : cut) total += measure(node).estimate;
    std::sort(cut.begin(), cut.end());
    const auto worst =
        std::max_element(cut.begin(), cut.end(), [&](std::uint32_t a, std::uint32_t b) { return error(a) < error(b); });
    if (!(error(*worst) > goal.error * total)) break;
    const std::uint32_t node = *worst;
    cut.erase(worst);
    for (const std::uint32_t child : {node + 1, std::uint32_t{tree.nodes()[node].second_or_light}}) {
      if (measure(child).bound > 0) cut.push_back(child);
    }
  }
  std::sort(cut.begin(), cut.end());
  return cut;
}

TEST_CASE("lightcuts: a cut is what its definition gives, node for node") {
  const LightTree tree(test::numbered(test::mixed_lights(200, 5)));
  const auto nodes = tree.nodes();
  Rng rng(8);
  std::size_t fewest = 1000, most = 0;
  for (const PointQuery& q : points()) {
    std::vector<CutMeasure> measures;
    for (const LightTree::Node& n : nodes) {
      const double bound = greatest_importance(n.bounds, n.two_sided, q);
      measures.push_back({bound, std::min(bound, 1e6) * (0.25 + 0.5 * rng.uniform())});
    }
    const auto measure = [&](std::uint32_t node) { return measures[node]; };
    if (!(measures[0].bound > 0)) continue;
    for (const CutGoal goal :
         {CutGoal{0.02, 1000, 0}, {0.2, 1000, 0}, {0.02, 7, 0}, {0, 50, 0}, {0.02, 1000, 1e9}, {0, 1, 0}}) {
      std::vector<std::uint32_t> found;
      for (const CutNode& n : refined_cut(tree, goal, measure)) found.push_back(n.node);
      REQUIRE(found == cut_by_definition(tree, goal, measure));
      if (!found.empty()) fewest = std::min(fewest, found.size());
      most = std::max(most, found.size());
    }
  }
  CHECK(fewest == 1);
  CHECK(most > 50);
}

TEST_CASE("lightcuts: of nodes with equal bounds the first in the tree is refined, and bound 0 leaves a node out") {
  const LightTree tree(test::numbered(std::vector<LightBounds>(16, test::point_bounds({1, 2, 3}, 1))));
  const auto equal = [](std::uint32_t) { return CutMeasure{1, 1}; };
  const auto cut = refined_cut(tree, {0, 5, 0}, equal);
  CHECK(cut.size() == 5);
  for (std::size_t i = 1; i < cut.size(); ++i) CHECK(cut[i - 1].node < cut[i].node);
  CHECK(refined_cut(tree, {0, 5, 0}, [](std::uint32_t) { return CutMeasure{0, 0}; }).empty());
  CHECK(refined_cut(LightTree{}, {}, equal).empty());
}

/// Every light that may contribute is held once, and each node has one candidate.
template <typename Query>
void check_cut(const LightSelector& selector, const Query& q, LightId lights, int most, std::size_t far) {
  const LightCut cut = selector.cut(q, {.candidates = most});
  CHECK(cut.size() <= static_cast<std::size_t>(most) + far);
  for (const LightCluster& c : cut) CHECK(c.candidates == 1);
  double sum = 0;
  for (LightId i = 0; i < lights; ++i) {
    const double n_pmf = selector.n_pmf(cut, q, i);
    CHECK(n_pmf <= 1 + 1e-6);
    if (selector.pmf(q, i) > 0) CHECK(n_pmf > 0);
    sum += n_pmf;
  }
  CHECK(sum <= double(cut.size()) * (1 + 1e-5));
}

TEST_CASE("lightcuts: a cut keeps to its nodes, and holds each light once") {
  for (const bool sun : {false, true}) {
    const auto selector = lightcuts(test::lights_of(300, sun));
    CHECK(selector->sizes_cut());
    const LightId n = sun ? 301 : 300;
    for (const int most : {1, 2, 20, 200, 1000}) {
      CAPTURE(most);
      for (const PointQuery& q : points()) check_cut(*selector, q, n, most, sun);
      for (const SegmentQuery& q : segments()) check_cut(*selector, q, n, most, sun);
    }
  }
}

TEST_CASE("lightcuts: far from all lights a few nodes stand for them, among them the near ones stand alone") {
  Rng rng(4);
  std::vector<LightBounds> lights;
  for (int i = 0; i < 2000; ++i) lights.push_back(test::point_bounds(test::random_in_cube(rng), 1));
  SelectionInput input;
  for (const TreeLight& l : test::numbered(lights)) {
    input.near.push_back(l);
    input.power.push_back(1);
  }
  const auto selector = lightcuts(input);
  const PointQuery far{{100, 0, 0}, {}}, among{lights[7].box.min + Vec3{1e-3f, 0, 0}, {}};
  const LightCut few = selector->cut(far, {.candidates = 0});
  CHECK(few.size() >= 50);  // none of them gives more than 2 %
  CHECK(few.size() < 150);
  const LightCut many = selector->cut(among, {.candidates = 0});
  CHECK(selector->n_pmf(many, among, 7) == 1);  // it gives nearly everything
  CHECK(many.size() < 1000);
  CHECK(selector->cut(PointQuery{{0.3f, 0.3f, 0.3f}, {}}, {.candidates = 0}).size() <= 1000);
}

TEST_CASE("lightcuts: lights at infinity are drawn one by one while there are not more than nodes, and then one for all") {
  SelectionInput input = test::lights_of(50, false);
  for (int i = 0; i < 9; ++i) {
    const Vec3 toward = normalize(Vec3{std::cos(float(i)), std::sin(float(i)), 0.5f});
    const float E = 1 + float(i);
    input.far.push_back({{{DirectionCone::around(toward), toward, E, E}}, static_cast<LightId>(input.power.size())});
    input.power.push_back(1);
  }
  const auto selector = lightcuts(input);
  const PointQuery q{};
  const LightCut many = selector->cut(q, {.candidates = 9}), few = selector->cut(q, {.candidates = 8});
  double sum = 0;
  for (LightId i = 50; i < 59; ++i) {
    CHECK(selector->n_pmf(many, q, i) == 1);
    CHECK(selector->n_pmf(few, q, i) == test::relative((1.0 + i - 50) / 45));
    sum += selector->n_pmf(few, q, i);
  }
  CHECK(sum == doctest::Approx(1));
}

template <typename Query>
void check_draws(const LightSelector& selector, const Query& q, LightId lights, int most) {
  constexpr int kRounds = 2000;
  const LightCut cut = selector.cut(q, {.candidates = most});
  std::vector<double> counts(lights), expected(lights);
  Rng rng(12);
  for (int round = 0; round < kRounds; ++round) {
    for (const LightCandidate& c : selector.draw(cut, q, rng.uniform_wide())) {
      REQUIRE(c.n_pmf == test::relative(selector.n_pmf(cut, q, c.light)).epsilon(1e-5));
      counts[c.light] += 1;
    }
  }
  // A node draws one of its lights a round: no more random than a Poisson count of the same mean.
  for (LightId i = 0; i < lights; ++i) {
    expected[i] = selector.n_pmf(cut, q, i) * kRounds;
    CHECK(std::abs(counts[i] - expected[i]) <= 5 * std::sqrt(expected[i]) + 5);
  }
}

TEST_CASE("lightcuts: each light is drawn as often as it says") {
  const auto selector = lightcuts(test::lights_of(60, true));
  for (const int most : {1, 5, 30}) {
    for (const PointQuery& q : points()) check_draws(*selector, q, 61, most);
    for (const SegmentQuery& q : segments()) check_draws(*selector, q, 61, most);
  }
}

// A node's choices alone: whether its lights follow their chances.
TEST_CASE("lightcuts: the lights of one node, by a chi-squared test") {
  const auto selector = lightcuts(test::lights_of(60, false));
  for (const PointQuery& q : points()) {
    const LightCut cut = selector->cut(q, {.candidates = 1});
    std::vector<double> pmf(61), counts(61);
    double sum = 0;
    for (LightId i = 0; i < 60; ++i) sum += pmf[i] = selector->n_pmf(cut, q, i);
    REQUIRE(sum < 1 + 1e-5);
    pmf[60] = std::max(0.0, 1 - sum);
    constexpr int kDraws = 10'000;
    Rng rng(5);
    for (int i = 0; i < kDraws; ++i) {
      const LightCandidates drawn = selector->draw(cut, q, rng.uniform_wide());
      counts[drawn.empty() ? 60 : drawn[0].light] += 1;
    }
    CHECK(test::count_p_value(counts, pmf, kDraws) > 1e-6);
  }
}

}  // namespace
}  // namespace tyndall
