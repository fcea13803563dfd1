#include <doctest/doctest.h>

#include <cmath>

#include "light/selection.h"
#include "light/wide_light_tree.h"
#include "light/wide_spread.h"
#include "light_cases.h"
#include "math/rng.h"
#include "support/relative.h"

namespace tyndall {
namespace {

std::vector<PointQuery> queries() {
  std::vector<LightBounds> box{test::point_bounds({-1, -1, -1}, 1), test::point_bounds({1, 1, 1}, 1)};
  auto all = test::queries_for(box, 30, 9);
  Rng rng(3);
  for (std::size_t i = 0; i < all.size(); i += 2) {
    if (length_squared(all[i].n) > 0) {
      test::add_lobe(all[i], test::random_direction(rng), 0.05f + 0.5f * rng.uniform());
    } else {
      all[i].g = 0.9f * rng.uniform();
      all[i].forward = test::random_direction(rng);
    }
  }
  return all;
}

TEST_CASE("where no light of the tree keeps what their common bounds promise, the sun has all candidates") {
  // Bundles of narrow spots around the point. In each one the spots look past it to all sides: their common bounds may
  // light anything, and none lights it.
  SelectionInput input;
  const auto add_near = [&input](Vec3 p, Vec3 axis) {
    input.near.push_back({test::spot_bounds(p, axis, 0.1f, 0.2f, 1e6f), static_cast<LightId>(input.power.size())});
    input.power.push_back(1);
  };
  for (int i = 0; i < 12; ++i) {
    const float a = static_cast<float>(i) * kPi / 6;
    const Vec3 out{std::cos(a), std::sin(a), 0}, along{-out.y, out.x, 0};
    for (const Vec3 axis : {along, -along, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) add_near(out * 10, normalize(axis + out * 0.5f));
  }
  const auto sun = static_cast<LightId>(input.power.size());
  input.far.push_back({{{DirectionCone::around({0, 0, 1}), {0, 0, 1}, 1e-3f, 1e-3f}}, sun});
  input.power.push_back(1e-3);
  const auto selector = make_selector(LightStrategy::tree, input);
  PointQuery q{};
  q.n = {0, 0, 1};
  for (const int n : {1, 4}) {
    const LightCut cut = selector->cut(q, {.candidates = n, .splitting = 0.9f});
    CHECK(test::total(cut) == doctest::Approx(n));
    CHECK(selector->n_pmf(cut, q, sun) == doctest::Approx(n));
    CHECK(selector->draw(cut, q, 0.3).size() == static_cast<std::size_t>(n));
  }
}

TEST_CASE("a cut keeps to its candidates, and its clusters hold each light once") {
  for (const bool sun : {false, true}) {
    const auto selector = make_selector(LightStrategy::tree, test::lights_of(300, sun));
    const auto n = static_cast<LightId>(sun ? 301 : 300);
    for (const CutSettings settings : {CutSettings{1, 1},
                                       {4, 0.9f},
                                       {8, 0},
                                       {8, 0.5f},
                                       {16, 1},
                                       {100, 1},
                                       {0, 0.8f},
                                       {0, 1},
                                       {1, 0, true},
                                       {8, 0, true},
                                       {100, 0, true}}) {
      CAPTURE(settings.candidates);
      CAPTURE(settings.splitting);
      for (const PointQuery& q : queries()) {
        const LightCut cut = selector->cut(q, settings);
        if (settings.candidates > 0 && !cut.empty()) CHECK(test::total(cut) == doctest::Approx(settings.candidates));
        // Every cluster gives its candidates one light each, but for what falls on dead branches.
        double sum = 0;
        for (LightId i = 0; i < n; ++i) {
          const double expected = selector->n_pmf(cut, q, i);
          if (cut.empty() || selector->pmf(q, i) == 0) continue;
          sum += expected;
          CHECK(expected > 0);
        }
        CHECK(sum <= test::total(cut) * (1 + 1e-5));
        if (settings.candidates > 0 && !settings.near_lights)
          CHECK(cut.size() <= static_cast<std::size_t>(std::max(settings.candidates, 15)) + 1);
      }
    }
  }
}

TEST_CASE("candidates go to clusters by importance, also where there are enough for each") {
  SelectionInput input;
  for (int i = 0; i < 8; ++i) {
    const float a = static_cast<float>(i) * kPi / 4, intensity = i == 0 ? 100.0f : 1.0f;
    input.near.push_back({test::point_bounds({10 * std::cos(a), 10 * std::sin(a), 0}, intensity), static_cast<LightId>(i)});
    input.power.push_back(intensity);
  }
  const auto selector = make_selector(LightStrategy::tree, input);
  const PointQuery middle{};
  const LightCut cut = selector->cut(middle, {.candidates = 16, .splitting = 1});
  REQUIRE(cut.size() == 8);
  CHECK(selector->n_pmf(cut, middle, 0) == doctest::Approx(16 * 100.0 / 107).epsilon(0.01));
  CHECK(selector->n_pmf(cut, middle, 1) == doctest::Approx(16 * 1.0 / 107).epsilon(0.05));
}

TEST_CASE("splitting 0 leaves all lights as one; 1 without a limit goes down to single lights") {
  const auto selector = make_selector(LightStrategy::tree, test::lights_of(200, false));
  for (const PointQuery& q : queries()) {
    CHECK(selector->cut(q, {7, 0}).size() <= 1);
    const LightCut all = selector->cut(q, {0, 1});
    for (LightId i = 0; i < 200; ++i) {
      const float expected = selector->n_pmf(all, q, i);
      CHECK((expected == 0 || expected == 1));
      if (selector->pmf(q, i) > 0) CHECK(expected == 1);
    }
  }
}

TEST_CASE("a phase function with a peak makes the cut finer where it points") {
  SelectionInput input;
  Rng rng(8);
  for (LightId i = 0; i < 2000; ++i) {
    input.near.push_back({test::point_bounds(test::random_in_cube(rng), 1), i});
    input.power.push_back(1);
  }
  const auto selector = make_selector(LightStrategy::tree, input);
  std::size_t toward = 0, away = 0, without = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 direction = test::random_direction(rng);
    PointQuery q{.p = direction * 6.0f, .n = {}};
    without += selector->cut(q, {0, 0.7f}).size();
    q.g = 0.97f;
    q.forward = -direction;
    toward += selector->cut(q, {0, 0.7f}).size();
    q.forward = direction;
    away += selector->cut(q, {0, 0.7f}).size();
  }
  CHECK(away == without);
  CHECK(toward > 3 * without);
}

TEST_CASE("draws from a cut: each light comes as often as expected, and its weight is 1 on average") {
  const auto selector = make_selector(LightStrategy::tree, test::lights_of(40, true));
  Rng rng(12);
  constexpr int kRounds = 2000;
  for (const CutSettings settings : {CutSettings{1, 0.9f},
                                     {3, 0.9f},
                                     {12, 0.9f},
                                     {20, 0.9f},
                                     {12, 0},
                                     {1, 0},
                                     {0, 0.6f},
                                     {4, 0.5f},
                                     {1, 0, true},
                                     {6, 0, true}}) {
    for (const PointQuery& q : queries()) {
      const LightCut cut = selector->cut(q, settings);
      std::vector<double> count(41);
      for (int round = 0; round < kRounds; ++round) {
        for (const LightCandidate& c : selector->draw(cut, q, rng.uniform_wide())) {
          REQUIRE(c.n_pmf == test::relative(selector->n_pmf(cut, q, c.light)).epsilon(1e-5));
          count[c.light] += 1;
        }
      }
      for (LightId i = 0; i < 41; ++i) {
        const double expected = selector->n_pmf(cut, q, i) * kRounds;
        // Strata make the count no more random than independent draws: over 5 deviations of a Poisson count, and room
        // for the few that fall where hardly any are expected.
        CHECK(std::abs(count[i] - expected) <= 5 * std::sqrt(expected) + 5);
      }
    }
  }
}

TEST_CASE("walks in step find what each finds alone") {
  const WideLightTree tree(test::numbered(test::mixed_lights(3000, 4)));
  Rng rng(31);
  for (const PointQuery& q : queries()) {
    const WideQuery local = tree.localize(q);
    std::array<WideLightTree::Draw, 7> draws;
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const double u = i == 3 ? 0x1p-21 * rng.uniform_wide() : (double(i) + rng.uniform_wide()) / 7;
      draws[i] = {i < 5 ? tree.root() : static_cast<WideLightTree::NodeRef>(i), u};
    }
    std::array<std::optional<WideLightTree::Choice>, 7> found;
    tree.select_below(draws, local, found);
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const auto alone = tree.select_below(draws[i].top, local, draws[i].u);
      REQUIRE(found[i].has_value() == alone.has_value());
      if (!alone) continue;
      CHECK(found[i]->light == alone->light);
      CHECK(found[i]->pmf == alone->pmf);
    }
  }
}

/// A node whose first child holds many points about `center`, and whose second is one point.
WideNode cloud(Vec3 center, float size, Rng& rng) {
  std::vector<Cluster> points;
  for (int i = 0; i < 2000; ++i) points.push_back(cluster_of(test::point_bounds(center + test::random_in_cube(rng, size), 1)));
  const std::array<Cluster, 2> children{cluster_union(points), points.front()};
  WideNode node{};
  node.set_children(children, std::array<std::uint32_t, 2>{1, 2});
  return node;
}

TEST_CASE("the spread of a cluster is that of its lights; single lights have none, one that holds the point has no end") {
  Rng rng(2);
  const WideNode node = cloud({2, 0, 0}, 0.5f, rng);
  CHECK(child_spread(node, {{2.1f, 0.2f, 0}, {}}).cv2[0] > 1e20f);
  CHECK(child_spread(node, {{0, 0, 0}, {}}).cv2[1] == 0);
  // 1/d^2 over the cube, by summing.
  double sum = 0, square = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Vec3 x = Vec3{2, 0, 0} + test::random_in_cube(rng, 0.5f);
    const double g = 1 / double(length_squared(x));
    sum += g;
    square += g * g;
  }
  const double cv2 = 1e5 * square / (sum * sum) - 1;
  CHECK(child_spread(node, {{0, 0, 0}, {}}).cv2[0] == doctest::Approx(cv2).epsilon(0.25));
}

TEST_CASE("a lobe within reach makes lights unlike, one out of reach does not") {
  Rng rng(3);
  const WideNode node = cloud({2, 0, 0}, 0.3f, rng);
  PointQuery q{.p = {}, .n = {1, 0, 0}};
  const auto cv2 = [&] {
    WideQuery local{q.p, q.n, true, false};
    local.diffuse = q.diffuse;
    local.lobe_count = q.lobe_count;
    local.lobes = q.lobes;
    return child_spread(node, local).cv2[0];
  };
  const float plain = cv2();
  test::add_lobe(q, {1, 0, 0}, 0.03f);
  CHECK(cv2() > 2 * plain + 1);
  q.lobes[0].sin_o = 0.9f;  // seen so that it mirrors light from elsewhere
  q.lobes[0].cos_o = 0.436f;
  CHECK(cv2() == plain);
}

}  // namespace
}  // namespace tyndall
