// What a tree says of the light that it chose is what it says when asked about that light: 10^5 pairs of a light and a
// question for each kind of both, half of them where trees break; 10^7 under TYNDALL_NIGHTLY.
#include <doctest/doctest.h>

#include <array>

#include "light/selection.h"
#include "support/measure.h"
#include "unit/light/segment_cases.h"

namespace tyndall {
namespace {

/// A case's lights, a sun, and a sky that scattered rays find, too.
SelectionInput input_of(const std::vector<LightBounds>& lights) {
  SelectionInput input;
  for (const LightBounds& l : lights) {
    input.near.push_back({l, static_cast<LightId>(input.power.size())});
    input.power.push_back(l.intensity);
  }
  const auto id = static_cast<LightId>(lights.size());
  input.far.push_back({{{DirectionCone::around({0, 0, 1}), {0, 0, 1}, 1e-3f, 1e-3f}}, id});
  input.far.push_back({{{DirectionCone::around({0, 0, 1}, kPi / 2), {0, 0, 0.5f}, 1, 0.1f}}, id + 1});
  input.power.insert(input.power.end(), {1, 1});
  return input;
}

struct Tally {
  std::size_t pairs = 0, none = 0;
};

/// The same of what a cut's candidates say.
template <typename Query>
void check_cut(const LightSelector& selector, const Query& q, double u) {
  const LightCut cut = selector.cut(q, {.candidates = 20});
  for (const LightCandidate& c : selector.draw(cut, q, u)) {
    const double n_pmf = selector.n_pmf(cut, q, c.light);
    REQUIRE(c.n_pmf > 0);
    REQUIRE(std::abs(n_pmf - c.n_pmf) <= 1e-6 * c.n_pmf);
  }
}

template <typename Query>
void check_pair(const LightSelector& selector, const Query& q, double u, Tally& tally) {
  ++tally.pairs;
  const auto s = selector.select(q, u);
  if (!s) {
    ++tally.none;
    return;
  }
  const double pmf = selector.pmf(q, s->light);
  if (!(s->pmf > 0) || !(std::abs(pmf - s->pmf) <= 1e-6 * s->pmf)) {
    CAPTURE(s->light);
    CAPTURE(pmf);
    CAPTURE(s->pmf);
    FAIL("select() and pmf() differ");
  }
}

void check_cases(LightStrategy strategy, const std::vector<test::LightCase>& cases, std::size_t pairs) {
  CAPTURE(name_of(strategy));
  Rng rng(17);
  Tally points, segments;
  for (const test::LightCase& c : cases) {
    CAPTURE(c.name);
    const auto selector = make_selector(strategy, input_of(c.lights));
    const std::size_t each = pairs / cases.size() + 1, questions = std::min<std::size_t>(each, 4000);
    const auto places = test::queries_for(c.lights, questions, 40);
    const auto spans = test::segments_for(c.lights, questions, 41);
    for (std::size_t i = 0; i < each; ++i) {
      const double u = i % 64 == 0 ? rng.uniform_wide() * 0x1p-20 : rng.uniform_wide();
      check_pair(*selector, places[i % questions], u, points);
      check_pair(*selector, spans[i % questions], u, segments);
      if (!selector->sizes_cut()) continue;
      check_cut(*selector, places[i % questions], u);
      check_cut(*selector, spans[i % questions], u);
    }
  }
  CHECK(points.none < points.pairs / 2);
  CHECK(segments.none < segments.pairs / 2);
}

constexpr std::array kTrees{LightStrategy::tree, LightStrategy::tree_binary, LightStrategy::cycles_rule,
                            LightStrategy::lightcuts, LightStrategy::cells};
const std::size_t kPairs = test::nightly() ? 10'000'000 : 100'000;

TEST_CASE("select() and pmf() agree: ordinary lights") {
  auto cases = test::light_cases();
  cases.push_back({"100,000 mixed lights", test::mixed_lights(100'000, 8)});
  for (const LightStrategy s : kTrees) check_cases(s, cases, s == LightStrategy::tree ? kPairs / 2 : kPairs / 20);
}

TEST_CASE("select() and pmf() agree: where trees break") {
  const auto cases = test::degenerate_cases(test::nightly() ? 1000 : 150);
  for (const LightStrategy s : kTrees) check_cases(s, cases, s == LightStrategy::tree ? kPairs / 2 : kPairs / 20);
}

}  // namespace
}  // namespace tyndall
