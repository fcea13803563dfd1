#include "light/selection.h"

#include <doctest/doctest.h>

#include "segment_cases.h"
#include "support/chi_squared.h"
#include "support/relative.h"
#include "support/strategies.h"

namespace tyndall {
namespace {

FarLight sun(LightId id, Vec3 toward, float E) { return {{{DirectionCone::around(toward), toward, E, E}}, id}; }

/// A sky of constant radiance over the upper hemisphere, in four cones; nothing of it is sampled beside scattered rays
/// unless `partner`.
FarLight upper_sky(LightId id, float radiance, bool partner) {
  FarLight sky{{}, id};
  for (int i = 0; i < 4; ++i) {
    const Vec3 corner{i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, 1};
    const float f = radiance * kPi / 2;
    sky.cones.push_back({DirectionCone::around(normalize(corner), 0.9554f), corner * 0.5f, f, partner ? f : 0});
  }
  return sky;
}

/// Mixed near lights, two suns and a sky; light 3 is dark.
SelectionInput mixed_input(std::size_t near, bool sky_partner) {
  SelectionInput input;
  const auto lights = test::mixed_lights(near, 3);
  LightId id = 0;
  for (const LightBounds& l : lights) {
    if (id == 3) {
      input.power.push_back(0);
      ++id;
    }
    input.near.push_back({l, id++});
    input.power.push_back(l.intensity);
  }
  input.far = {sun(id, {0, 0, 1}, 1000), sun(id + 1, normalize(Vec3{1, 0, -1}), 1e-3f), upper_sky(id + 2, 1, sky_partner)};
  for (const double p : {1e4, 1e-2, 3e3}) input.power.push_back(p);
  return input;
}

/// All that choose: exhaustive takes every light.
const std::vector<LightStrategy> kStrategies = [] {
  std::vector<LightStrategy> all = test::every_lights();
  std::erase(all, LightStrategy::exhaustive);
  return all;
}();

std::vector<PointQuery> queries() {
  std::vector<LightBounds> box{test::point_bounds({-1, -1, -1}, 1), test::point_bounds({1, 1, 1}, 1)};
  return test::queries_for(box, 40, 8);
}

std::vector<SegmentQuery> segments() {
  std::vector<LightBounds> box{test::point_bounds({-1, -1, -1}, 1), test::point_bounds({1, 1, 1}, 1)};
  return test::segments_for(box, 27, 8);
}

/// The probabilities of a selector's choices by pmf(), and how well draws follow them.
template <typename Query>
void check_draws(const LightSelector& selector, const Query& q, LightId n) {
  double sum = 0;
  std::vector<double> pmf(n + 1), counts(n + 1);
  for (LightId i = 0; i < n; ++i) sum += pmf[i] = selector.pmf(q, i);
  REQUIRE(sum < 1 + 1e-5);
  pmf[n] = std::max(0.0, 1 - sum);
  CHECK(pmf[3] == 0);
  constexpr int kDraws = 10'000;
  Rng rng(4);
  for (int i = 0; i < kDraws; ++i) {
    const auto s = selector.select(q, rng.uniform_wide());
    if (s) REQUIRE(std::abs(s->pmf - selector.pmf(q, s->light)) <= 1e-6 * s->pmf);
    counts[s ? s->light : n] += 1;
  }
  CHECK(test::count_p_value(counts, pmf, kDraws) > 1e-6);
}

TEST_CASE("every strategy: probabilities sum to at most 1, and draws follow them") {
  for (const LightStrategy strategy : kStrategies) {
    CAPTURE(name_of(strategy));
    const SelectionInput input = mixed_input(60, true);
    const auto n = static_cast<LightId>(input.power.size());
    const auto selector = make_selector(strategy, input);
    for (const PointQuery& q : queries()) check_draws(*selector, q, n);
    for (const SegmentQuery& q : segments()) check_draws(*selector, q, n);
  }
}

TEST_CASE("where one light alone has power nothing is asked: it is chosen, from everywhere") {
  SelectionInput input;
  input.power = {0, 0, 5, 0};
  input.near.push_back({test::point_bounds({1, 2, 3}, 5), 2});
  for (const LightStrategy strategy : kStrategies) {
    CAPTURE(name_of(strategy));
    const auto selector = make_selector(strategy, input);
    CHECK(selector->memory_bytes() < 100);
    for (const PointQuery& q : queries()) {
      const LightCut cut = selector->cut(q, {.candidates = 3, .splitting = 0.5f});
      const LightCandidates drawn = selector->draw(cut, q, 0.4);
      REQUIRE(drawn.size() == 3);
      for (const LightCandidate& c : drawn) {
        CHECK(c.light == 2);
        CHECK(c.n_pmf == 3);
      }
      CHECK(selector->n_pmf(cut, q, 2) == 3);
      CHECK(selector->n_pmf(cut, q, 1) == 0);
    }
    for (const SegmentQuery& q : segments()) {
      CHECK(selector->select(q, 0.9)->light == 2);
      CHECK(selector->pmf(q, 2) == 1);
    }
  }
}

TEST_CASE("lights at infinity along a segment: by irradiance, length, and what the medium makes of it") {
  const FarLight lights[] = {sun(0, {1, 0, 0}, 2), sun(1, {-1, 0, 0}, 1), upper_sky(2, 0.5f, true)};
  const FarLights far(lights);
  SegmentQuery q{.o = {}, .d = {1, 0, 0}, .t0 = 1, .t1 = 5, .importance = MediaStrategy::integral, .reach = 10};
  const double sky = 0.5 * 2 * kPi;
  CHECK(far.importance(q) == doctest::Approx(4 * (2 + 1 + sky)));
  CHECK(far.pmf(q, 0) == doctest::Approx(2 / (3 + sky)));
  q.reach = 3;  // the segment is longer
  CHECK(far.importance(q) == doctest::Approx(3 * (2 + 1 + sky)));
  q.t1 = kInfinity;
  CHECK(far.importance(q) == doctest::Approx(3 * (2 + 1 + sky)));

  // Half of the reach scatters, a third of that arrives; forward scattering favours the sun ahead.
  q.importance = MediaStrategy::product;
  q.profile.edge.fill(kInfinity);
  q.profile.edge[0] = 1;
  q.profile.edge[1] = 2.5f;
  q.profile.scattering[0] = 0.2f;
  q.profile.sigma[0] = 1;
  q.profile.escape[0] = std::log(3.0f);
  CHECK(far.importance(q) == doctest::Approx(3 * 0.5 / 3 * (2 + 1 + sky)));
  q.profile.edge[1] = kInfinity;  // only 3 of it are within reach
  CHECK(far.importance(q) == doctest::Approx(3.0 / 3 * (2 + 1 + sky)));
  q.profile.edge[1] = 2.5f;
  q.profile.g = 0.5f;
  const double ahead = 0.75 / std::pow(0.5, 3), behind = 0.75 / std::pow(1.5, 3);
  CHECK(far.pmf(q, 0) / far.pmf(q, 1) == doctest::Approx(2 * ahead / behind));
  q.profile.escape[0] = kInfinity;  // nothing arrives, by the profile
  CHECK(far.pmf(q, 0) / far.pmf(q, 1) == doctest::Approx(2));
  CHECK(far.importance(q) > 0);
}

TEST_CASE("a sun and a near light of the same effect on a segment share the choice") {
  SelectionInput input;
  input.near.push_back({test::point_bounds({0, 0, 1000}, 1e6f), 0});  // 1 W/m^2 there
  input.far.push_back(sun(1, {0, 0, 1}, 1));
  input.power = {1, 1};
  for (const LightStrategy strategy : {LightStrategy::tree, LightStrategy::tree_binary}) {
    const auto selector = make_selector(strategy, input);
    for (const MediaStrategy m : {MediaStrategy::closest, MediaStrategy::integral, MediaStrategy::product}) {
      SegmentQuery q{.o = {}, .d = {1, 0, 0}, .t0 = 0, .t1 = 8, .importance = m, .reach = 100};
      q.profile = test::homogeneous_profile(0, 8, 0.3f, 2, 0.6f);
      CHECK(selector->pmf(q, 0) == doctest::Approx(0.5).epsilon(0.01));
      CHECK(selector->pmf(q, 0) + selector->pmf(q, 1) == doctest::Approx(1));
    }
  }
}

TEST_CASE("uniform gives every light with power the same, power gives each its share") {
  const SelectionInput input = mixed_input(10, true);
  double total = 0;
  for (const double p : input.power) total += p;
  const auto uniform = make_selector(LightStrategy::uniform, input), power = make_selector(LightStrategy::power, input);
  for (LightId i = 0; i < input.power.size(); ++i) {
    CHECK(uniform->pmf(PointQuery{}, i) == test::relative(i == 3 ? 0 : 1.0 / (double(input.power.size()) - 1)));
    CHECK(power->pmf(PointQuery{}, i) == test::relative(input.power[i] / total));
  }
}

TEST_CASE("tree: neither near nor far lights starve, and a light below the horizon gets nothing") {
  const SelectionInput input = mixed_input(60, true);
  const auto selector = make_selector(LightStrategy::tree_binary, input);
  const auto first_far = static_cast<LightId>(input.power.size() - 3);
  const auto far_share = [&](const PointQuery& q) {
    return selector->pmf(q, first_far) + selector->pmf(q, first_far + 1) + selector->pmf(q, first_far + 2);
  };
  for (const float distance : {0.1f, 10.0f, 1e6f}) {
    CHECK(far_share({{0, 0, distance}, {}}) > 0.099);
    CHECK(far_share({{0, 0, distance}, {}}) < 0.901);
  }
  const PointQuery up{{0, 0, -5}, {0, 0, 1}}, down{{0, 0, 5}, {0, 0, -1}};
  CHECK(selector->pmf(up, first_far) > 100 * selector->pmf(up, first_far + 2));  // the sun outshines the sky
  CHECK(selector->pmf(up, first_far + 1) == 0);                                  // this one is below
  CHECK(selector->pmf(down, first_far) == 0);
  CHECK(selector->pmf(down, first_far + 1) > 0);
  CHECK(selector->pmf(PointQuery{down.p, down.n, true}, first_far) > 0);
}

TEST_CASE("tree: an environment that scattered rays look after takes no part") {
  const SelectionInput input = mixed_input(5, false);
  const auto selector = make_selector(LightStrategy::tree_binary, input);
  const auto sky = static_cast<LightId>(input.power.size() - 1);
  const PointQuery q{{0, 0, 0}, {0, 0, 1}};
  CHECK(selector->pmf(q, sky) == 0);
  CHECK(make_selector(LightStrategy::tree_binary, mixed_input(5, true))->pmf(q, sky) > 0);
}

TEST_CASE("the importance of a sky is its irradiance where all of each cone is seen") {
  const std::vector<FarLight> lights{upper_sky(0, 1, true)};
  const FarLights far(lights);
  CHECK(far.importance({{}, {0, 0, 1}}) == doctest::Approx(kPi));
  CHECK(far.importance({{}, {}}) == doctest::Approx(2 * kPi));
  CHECK(far.importance({{}, {0, 0, -1}}) < 0.5 * kPi);
}

TEST_CASE("nothing to choose from") {
  for (const LightStrategy strategy : kStrategies) {
    CHECK(!make_selector(strategy, {})->select(PointQuery{}, 0.5));
    const auto dark = make_selector(strategy, {{0, 0}, {}, {}});
    CHECK(!dark->select(PointQuery{}, 0.5));
    CHECK(dark->pmf(PointQuery{}, 1) == 0);
  }
}

}  // namespace
}  // namespace tyndall
