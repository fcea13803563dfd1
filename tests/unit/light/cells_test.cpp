#include <doctest/doctest.h>

#include "light/cell_selector.h"
#include "light_cases.h"
#include "segment_cases.h"
#include "support/relative.h"

namespace tyndall {
namespace {

SelectionInput points_of(const std::vector<LightBounds>& lights) {
  SelectionInput input;
  for (const TreeLight& l : test::numbered(lights)) {
    input.near.push_back(l);
    input.power.push_back(l.bounds.intensity);
  }
  return input;
}

std::vector<PointQuery> questions(std::size_t count) {
  return test::queries_for({test::point_bounds({-1, -1, -1}, 1), test::point_bounds({1, 1, 1}, 1)}, count, 8);
}

CellDensities cells_of(const SelectionInput& input, int threads) {
  const LightTree tree(input.near);
  return CellDensities(tree, FarLights(input.far), input.region, threads);
}

TEST_CASE("cells: the same for any number of threads") {
  const SelectionInput input = test::lights_of(300, true);
  const CellDensities one = cells_of(input, 1), three = cells_of(input, 3);
  std::size_t clusters = 0;
  for (const PointQuery& q : questions(3000)) {
    const auto a = one.at(q), b = three.at(q);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK(a[i].node == b[i].node);
      CHECK(a[i].below == b[i].below);
    }
    clusters += a.size();
  }
  CHECK(clusters > 30'000);
}

// An integral by other means: random points of the cell, lights by 1/r^2 and the cosine alone.
TEST_CASE("cells: a light's share is what it gives to the cell on average") {
  // Six lights around a scene of three boxes a side (2 cbrt(6), rounded down); the cell in question is the middle.
  const std::vector<LightBounds> lights{test::point_bounds({-4, -4, -4}, 1), test::point_bounds({4, -4, -4}, 3),
                                        test::point_bounds({-4, 4, 4}, 2),   test::point_bounds({4, 4, 4}, 1),
                                        test::point_bounds({4, -4, 4}, 5),   test::point_bounds({-4, 4, -4}, 1)};
  SelectionInput input = points_of(lights);
  input.region = {{-1.5f, -1.5f, -1.5f}, {1.5f, 1.5f, 1.5f}};
  const CellDensities cells = cells_of(input, 1);
  const LightTree tree(input.near);
  const Vec3 low{-0.5f, -0.5f, -0.5f};
  for (const bool surface : {false, true}) {
    PointQuery q{Vec3{0.1f, -0.2f, 0.3f}, surface ? normalize(Vec3{0.9f, 0.1f, -0.2f}) : Vec3{}};
    const auto clusters = cells.at(q);
    REQUIRE(clusters.size() >= 3);
    std::array<double, 6> given{};
    double total = 0;
    Rng rng(3);
    for (int k = 0; k < 20'000; ++k) {
      const Vec3 p = low + Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
      const Vec3 n = normalize(Vec3{1, 2 * rng.uniform() - 1, 2 * rng.uniform() - 1});
      for (std::size_t i = 0; i < 6; ++i) {
        const Vec3 to = lights[i].box.min - p;
        const double d2 = length_squared(to), cosine = surface ? std::max(dot(n, to) / std::sqrt(d2), 0.0) : 1;
        given[i] += lights[i].intensity * cosine / d2;
        total += lights[i].intensity * cosine / d2;
      }
    }
    double before = 0;
    for (const CellDensities::Cluster& c : clusters) {
      REQUIRE(tree.nodes()[c.node].leaf);
      const double share = c.below - before;
      before = c.below;
      CHECK(share == doctest::Approx(given[tree.nodes()[c.node].second_or_light] / total).epsilon(surface ? 0.1 : 0.02));
    }
    CHECK(before == 1);
  }
}

TEST_CASE("cells: the tree keeps a quarter, so no light is beyond reach") {
  const SelectionInput input = test::lights_of(200, true);
  const auto cells = make_selector(LightStrategy::cells, input), tree = make_selector(LightStrategy::tree_binary, input);
  int better = 0;
  for (const PointQuery& q : questions(120)) {
    for (LightId i = 0; i < 201; ++i) {
      CHECK(cells->pmf(q, i) >= 0.25f * tree->pmf(q, i) * (1 - 1e-6f));
      better += cells->pmf(q, i) > tree->pmf(q, i);
    }
  }
  CHECK(better > 1000);
}

TEST_CASE("cells: a point outside of the grid and a segment choose as the tree does") {
  const SelectionInput input = test::lights_of(100, true);
  const auto cells = make_selector(LightStrategy::cells, input), tree = make_selector(LightStrategy::tree_binary, input);
  const PointQuery outside{{50, 0, 0}, {-1, 0, 0}};
  for (LightId i = 0; i < 101; ++i) CHECK(cells->pmf(outside, i) == tree->pmf(outside, i));
  for (const SegmentQuery& q : test::segments_for({input.near[0].bounds, input.near[1].bounds}, 18, 3)) {
    const auto a = cells->select(q, 0.37), b = tree->select(q, 0.37);
    REQUIRE(a.has_value() == b.has_value());
    if (!a) continue;
    CHECK(a->light == b->light);
    CHECK(a->pmf == b->pmf);
  }
  // What lies beyond the scene has no cells.
  SelectionInput clipped = input;
  clipped.region = {{-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}};
  const auto small = make_selector(LightStrategy::cells, clipped);
  const PointQuery beside{{0.5f, 0.5f, 0.5f}, {}};
  for (LightId i = 0; i < 101; ++i) CHECK(small->pmf(beside, i) == tree->pmf(beside, i));
}

TEST_CASE("cells: surfaces of one cell that face apart choose apart") {
  const std::vector<LightBounds> lights{test::point_bounds({0, 0, 1}, 1), test::point_bounds({0, 0, -1}, 1),
                                        test::point_bounds({1, 0, 0}, 1)};
  const auto selector = make_selector(LightStrategy::cells, points_of(lights));
  CHECK(selector->pmf(PointQuery{{0, 0, 0}, {0, 0, 1}}, 0) > 0.8f);
  CHECK(selector->pmf(PointQuery{{0, 0, 0}, {0, 0, 1}}, 1) == 0);
  CHECK(selector->pmf(PointQuery{{0, 0, 0}, {0, 0, -1}}, 1) > 0.4f);
  CHECK(selector->pmf(PointQuery{{0, 0, 0}, {0, 0, -1}}, 0) == 0);
  PointQuery both{{0, 0, 0}, {0, 0, 1}, true};
  CHECK(selector->pmf(both, 0) > 0.2f);
  CHECK(selector->pmf(both, 1) > 0.2f);
}

TEST_CASE("cells: memory has a limit, whatever there is") {
  for (const std::size_t n : {2u, 10u, 300u, 5000u}) {
    const CellDensities cells = cells_of(points_of(test::mixed_lights(n, n)), 0);
    CHECK(cells.memory_bytes() <= CellDensities::most_bytes(double(n)));
  }
  CHECK(CellDensities::most_bytes(1e9) < 40'000'000);
}

}  // namespace
}  // namespace tyndall
