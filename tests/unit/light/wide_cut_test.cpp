#include <doctest/doctest.h>

#include <cmath>

#include "light/selection.h"
#include "light_cases.h"
#include "math/rng.h"

namespace tyndall {
namespace {

SelectionInput lights_of(std::size_t count, bool sun) {
  SelectionInput input;
  for (const LightBounds& l : test::mixed_lights(count, 5)) {
    input.near.push_back({l, static_cast<LightId>(input.power.size())});
    input.power.push_back(l.intensity);
  }
  if (sun) {
    input.far.push_back({{{DirectionCone::around({0, 0, 1}), {0, 0, 1}, 3, 3}}, static_cast<LightId>(input.power.size())});
    input.power.push_back(10);
  }
  return input;
}

std::uint32_t total(const LightCut& cut) {
  std::uint32_t sum = 0;
  for (const LightCluster& c : cut) sum += c.candidates;
  return sum;
}

std::vector<PointQuery> queries() {
  std::vector<LightBounds> box{test::point_bounds({-1, -1, -1}, 1), test::point_bounds({1, 1, 1}, 1)};
  auto all = test::queries_for(box, 30, 9);
  Rng rng(3);
  for (std::size_t i = 0; i < all.size(); i += 2) all[i].lobes[0] = {test::random_direction(rng), 0.05f + 0.5f * rng.uniform()};
  return all;
}

TEST_CASE("a cut keeps to its candidates, and its clusters hold each light once") {
  for (const bool sun : {false, true}) {
    const auto selector = make_selector(LightStrategy::tree, lights_of(300, sun));
    const auto n = static_cast<LightId>(sun ? 301 : 300);
    for (const CutSettings settings : {CutSettings{1, 1}, {4, 0.9f}, {8, 0}, {8, 0.5f}, {16, 1}, {100, 1}, {0, 0.8f}, {0, 1}}) {
      CAPTURE(settings.candidates);
      CAPTURE(settings.splitting);
      for (const PointQuery& q : queries()) {
        const LightCut cut = selector->cut(q, settings);
        if (settings.candidates > 0 && !cut.empty()) CHECK(total(cut) == static_cast<std::uint32_t>(settings.candidates));
        // Every cluster gives its candidates one light each, but for what falls on dead branches.
        double sum = 0;
        for (LightId i = 0; i < n; ++i) {
          const double expected = selector->expected(cut, q, i);
          if (cut.empty() || selector->pmf(q, i) == 0) continue;
          sum += expected;
          CHECK(expected > 0);
        }
        CHECK(sum <= total(cut) * (1 + 1e-5));
      }
    }
  }
}

TEST_CASE("splitting 0 leaves all lights as one; 1 without a limit goes down to single lights") {
  const auto selector = make_selector(LightStrategy::tree, lights_of(200, false));
  for (const PointQuery& q : queries()) {
    CHECK(selector->cut(q, {7, 0}).size() <= 1);
    const LightCut all = selector->cut(q, {0, 1});
    for (LightId i = 0; i < 200; ++i) {
      const float expected = selector->expected(all, q, i);
      CHECK((expected == 0 || expected == 1));
      if (selector->pmf(q, i) > 0) CHECK(expected == 1);
    }
  }
}

TEST_CASE("a lobe makes the cut finer where it points") {
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
    q.lobes[0] = {-direction, 0.05f};
    toward += selector->cut(q, {0, 0.7f}).size();
    q.lobes[0].axis = direction;
    away += selector->cut(q, {0, 0.7f}).size();
  }
  CHECK(away == without);
  CHECK(toward > 3 * without);
}

TEST_CASE("draws from a cut: each light comes as often as expected, and its weight is 1 on average") {
  const auto selector = make_selector(LightStrategy::tree, lights_of(40, true));
  Rng rng(12);
  constexpr int kRounds = 4000;
  for (const CutSettings settings : {CutSettings{3, 0.9f}, {12, 0.9f}, {12, 0}}) {
    for (const PointQuery& q : queries()) {
      const LightCut cut = selector->cut(q, settings);
      std::vector<double> count(41);
      for (int round = 0; round < kRounds; ++round) {
        for (const LightCluster& c : cut) {
          const double u = rng.uniform_wide();
          for (std::uint32_t i = 0; i < c.candidates; ++i) {
            const auto s = selector->select_in(c, q, (i + u) / c.candidates);
            if (!s) continue;
            REQUIRE(s->pmf * c.candidates == doctest::Approx(selector->expected(cut, q, s->light)).epsilon(1e-5));
            count[s->light] += 1;
          }
        }
      }
      for (LightId i = 0; i < 41; ++i) {
        const double expected = selector->expected(cut, q, i) * kRounds;
        // Strata make the count no more random than independent draws: over 5 deviations of a Poisson count, and room
        // for the few that fall where hardly any are expected.
        CHECK(std::abs(count[i] - expected) <= 5 * std::sqrt(expected) + 5);
      }
    }
  }
}

}  // namespace
}  // namespace tyndall
