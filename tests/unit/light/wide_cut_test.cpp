#include <doctest/doctest.h>

#include <cmath>

#include "light/selection.h"
#include "light/split_measure.h"
#include "light/wide_light_tree.h"
#include "math/rng.h"
#include "segment_cases.h"

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

std::vector<SegmentQuery> segments() {
  std::vector<LightBounds> box{test::point_bounds({-1, -1, -1}, 1), test::point_bounds({1, 1, 1}, 1)};
  return test::segments_for(box, 27, 9);
}

template <typename Query>
void check_cut(const LightSelector& selector, const Query& q, const CutSettings& settings, LightId n) {
  const LightCut cut = selector.cut(q, settings);
  if (settings.candidates > 0 && !cut.empty()) CHECK(total(cut) == static_cast<std::uint32_t>(settings.candidates));
  // Every cluster gives its candidates one light each, but for what falls on dead branches.
  double sum = 0;
  for (LightId i = 0; i < n; ++i) {
    const double expected = selector.expected(cut, q, i);
    if (cut.empty() || selector.pmf(q, i) == 0) continue;
    sum += expected;
    CHECK(expected > 0);
  }
  CHECK(sum <= total(cut) * (1 + 1e-5));
}

TEST_CASE("a cut keeps to its candidates, and its clusters hold each light once") {
  for (const bool sun : {false, true}) {
    const auto selector = make_selector(LightStrategy::tree, lights_of(300, sun));
    const auto n = static_cast<LightId>(sun ? 301 : 300);
    for (const CutSettings settings : {CutSettings{1, 1}, {4, 0.9f}, {8, 0}, {8, 0.5f}, {16, 1}, {100, 1}, {0, 0.8f}, {0, 1}}) {
      CAPTURE(settings.candidates);
      CAPTURE(settings.splitting);
      for (const PointQuery& q : queries()) check_cut(*selector, q, settings, n);
      for (const SegmentQuery& q : segments()) check_cut(*selector, q, settings, n);
    }
  }
}

template <typename Query>
void check_extremes(const LightSelector& selector, const Query& q, LightId n) {
  CHECK(selector.cut(q, {7, 0}).size() <= 1);
  const LightCut all = selector.cut(q, {0, 1});
  for (LightId i = 0; i < n; ++i) {
    const float expected = selector.expected(all, q, i);
    CHECK((expected == 0 || expected == 1));
    if (selector.pmf(q, i) > 0) CHECK(expected == 1);
  }
}

TEST_CASE("splitting 0 leaves all lights as one; 1 without a limit goes down to single lights") {
  const auto selector = make_selector(LightStrategy::tree, lights_of(200, false));
  for (const PointQuery& q : queries()) check_extremes(*selector, q, 200);
  for (const SegmentQuery& q : segments()) check_extremes(*selector, q, 200);
}

TEST_CASE("what a segment crosses is split at any threshold, what lies aside by its distance") {
  std::vector<LightBounds> lights;
  Rng rng(6);
  for (int i = 0; i < 1000; ++i) lights.push_back(test::point_bounds(test::random_in_cube(rng), 1));
  const WideLightTree tree(test::numbered(lights));
  const Cluster all = tree.cluster(tree.root());
  const auto measure = [&](Vec3 o, Vec3 d, float t1, float g = 0, float sigma = 0) {
    SegmentQuery q{.o = o, .d = d, .t0 = 0, .t1 = t1};
    q.profile = test::homogeneous_profile(0, t1, sigma, 100, g);
    return split_measure(all, tree.localize(q));
  };
  CHECK(measure({-3, 0, 0}, {1, 0, 0}, 1.2f).score() > 0);
  CHECK(measure({-3, 0, 0}, {1, 0, 0}, 1.5f).score() == 0);  // reaches the sphere around the box
  CHECK(measure({-9, 0.5f, 0}, {1, 0, 0}, kInfinity).score() == 0);
  CHECK(measure({0, 0, 0}, {1, 0, 0}, 1e-3f).score() == 0);
  const SplitMeasure aside = measure({-9, 0, 10}, {1, 0, 0}, kInfinity);
  CHECK(aside.nearest / tree.to_unit({}) == doctest::Approx(10 - std::sqrt(3)).epsilon(0.01));
  CHECK(aside.farthest / tree.to_unit({}) == doctest::Approx(10 + std::sqrt(3)).epsilon(0.01));
  CHECK(aside.cv2 == doctest::Approx(12 / (3.0 * (100 - 3))).epsilon(0.02));
  CHECK(measure({-9, 0, 100}, {1, 0, 0}, kInfinity).score() > aside.score());

  // A dense medium tells near from far: x / 2 coth(x / 2) with x = 2 sqrt(3) sigma on top.
  const double x = 2 * std::sqrt(3.0) * 0.7;
  CHECK(1 + measure({-9, 0, 10}, {1, 0, 0}, 50, 0, 0.7f).cv2 ==
        doctest::Approx((1 + aside.cv2) * 0.5 * x / std::tanh(0.5 * x)).epsilon(0.02));
  // So does a forward peak that the lights are in, and one that they are not in does not.
  // By where the segment begins, to which light is scattered forward: from its end the lights are off the peak.
  CHECK(measure({-30, 0, 4}, {1, 0, 0}, 24, 0.9f, 1e-6f).cv2 > 1.5 * measure({-30, 0, 4}, {1, 0, 0}, 24, 0, 1e-6f).cv2);
  CHECK(measure({-20, 0, 2}, {1, 0, 0}, 4, 0.9f, 1e-6f).cv2 > 2 * measure({-20, 0, 2}, {1, 0, 0}, 4, 0, 1e-6f).cv2);
  CHECK(measure({-20, 0, 2}, {1, 0, 0}, 4, -0.9f, 1e-6f).cv2 ==
        doctest::Approx(measure({-20, 0, 2}, {1, 0, 0}, 4, 0, 1e-6f).cv2));
  CHECK(measure({-20, 0, 2}, {-1, 0, 0}, 4, -0.9f, 1e-6f).cv2 > 2 * measure({-20, 0, 2}, {-1, 0, 0}, 4, 0, 1e-6f).cv2);
}

TEST_CASE("the phase function's lobe ends where it has fallen to half") {
  for (const float g : {0.7f, 0.9f, 0.99f, -0.8f}) {
    const QueryLobe lobe = phase_lobe(g, {0, 0, 1});
    CHECK(lobe.axis.z == (g > 0 ? 1 : -1));
    const auto at = [&](double angle) { return phase_ratio(std::abs(g), std::cos(angle)); };
    CHECK(at(lobe.width) == doctest::Approx(0.5 * at(0)).epsilon(1e-3));
  }
  CHECK(phase_lobe(0, {0, 0, 1}).width == 0);
  CHECK(phase_lobe(0.1f, {0, 0, 1}).width == 0);  // half is nowhere
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

template <typename Query>
void check_draws(const LightSelector& selector, const Query& q, const CutSettings& settings, LightId n) {
  constexpr int kRounds = 4000;
  Rng rng(12);
  const LightCut cut = selector.cut(q, settings);
  std::vector<double> count(n);
  for (int round = 0; round < kRounds; ++round) {
    for (const LightCluster& c : cut) {
      const double u = rng.uniform_wide();
      for (std::uint32_t i = 0; i < c.candidates; ++i) {
        const auto s = selector.select_in(c, q, (i + u) / c.candidates);
        if (!s) continue;
        REQUIRE(s->pmf * c.candidates == doctest::Approx(selector.expected(cut, q, s->light)).epsilon(1e-5).scale(0));
        count[s->light] += 1;
      }
    }
  }
  for (LightId i = 0; i < n; ++i) {
    const double expected = selector.expected(cut, q, i) * kRounds;
    // Strata make the count no more random than independent draws: over 5 deviations of a Poisson count, and room
    // for the few that fall where hardly any are expected.
    CHECK(std::abs(count[i] - expected) <= 5 * std::sqrt(expected) + 5);
  }
}

template <typename Query>
void check_all_at_once(const LightSelector& selector, const Query& q, const CutSettings& settings, Rng& rng) {
  const LightCut cut = selector.cut(q, settings);
  std::vector<double> u;
  for (std::uint32_t i = 0; i < total(cut); ++i) u.push_back(i % 9 == 8 ? rng.uniform_wide() * 0x1p-20 : rng.uniform_wide());
  std::vector<std::optional<SelectedLight>> selected(u.size(), SelectedLight{7, -1});
  selector.select_all(cut, q, u, selected);
  std::size_t i = 0;
  for (const LightCluster& c : cut) {
    for (std::uint32_t k = 0; k < c.candidates; ++k, ++i) {
      const auto one = selector.select_in(c, q, u[i]);
      REQUIRE(one.has_value() == selected[i].has_value());
      if (!one) continue;
      REQUIRE(one->light == selected[i]->light);
      REQUIRE(one->pmf == selected[i]->pmf);
    }
  }
}

TEST_CASE("all candidates at once are those drawn one by one") {
  for (const LightStrategy strategy : {LightStrategy::tree, LightStrategy::tree_binary, LightStrategy::power}) {
    const auto selector = make_selector(strategy, lights_of(300, true));
    Rng rng(4);
    for (const CutSettings settings : {CutSettings{1, 0.9f}, {5, 0.9f}, {40, 0.9f}, {12, 0}, {0, 1}}) {
      for (const PointQuery& q : queries()) check_all_at_once(*selector, q, settings, rng);
      for (const SegmentQuery& q : segments()) check_all_at_once(*selector, q, settings, rng);
    }
  }
}

TEST_CASE("draws from a cut: each light comes as often as expected, and its weight is 1 on average") {
  const auto selector = make_selector(LightStrategy::tree, lights_of(40, true));
  for (const CutSettings settings : {CutSettings{3, 0.9f}, {12, 0.9f}, {12, 0}}) {
    for (const PointQuery& q : queries()) check_draws(*selector, q, settings, 41);
    for (const SegmentQuery& q : segments()) check_draws(*selector, q, settings, 41);
  }
}

}  // namespace
}  // namespace tyndall
