/// Cuts through the wide tree for segments of rays; those for points are in wide_cut_test.
#include <doctest/doctest.h>

#include <cmath>

#include "light/selection.h"
#include "light/split_measure.h"
#include "light/wide_light_tree.h"
#include "math/rng.h"
#include "segment_cases.h"
#include "support/relative.h"

namespace tyndall {
namespace {

std::vector<SegmentQuery> segments() {
  std::vector<LightBounds> box{test::point_bounds({-1, -1, -1}, 1), test::point_bounds({1, 1, 1}, 1)};
  return test::segments_for(box, 27, 9);
}

TEST_CASE("a segment's cut keeps to its candidates, and its clusters hold each light once") {
  for (const bool sun : {false, true}) {
    const auto selector = make_selector(LightStrategy::tree, test::lights_of(300, sun));
    for (const CutSettings settings : {CutSettings{1, 0.9f}, {5, 0.9f}, {40, 0.9f}, {12, 0}, {0, 0.5f}}) {
      for (const SegmentQuery& q : segments()) {
        const LightCut cut = selector->cut(q, settings);
        if (settings.candidates > 0 && !cut.empty()) CHECK(test::total(cut) == doctest::Approx(settings.candidates));
        double sum = 0;
        for (LightId i = 0; i < (sun ? 301u : 300u); ++i) {
          if (selector->pmf(q, i) == 0) continue;
          CHECK(selector->n_pmf(cut, q, i) > 0);
          sum += selector->n_pmf(cut, q, i);
        }
        CHECK(sum <= test::total(cut) * (1 + 1e-5));
      }
    }
  }
}

TEST_CASE("draws from a segment's cut: each light comes as often as expected, and its weight is 1 on average") {
  constexpr int kRounds = 4000;
  const auto selector = make_selector(LightStrategy::tree, test::lights_of(40, true));
  Rng rng(12);
  for (const CutSettings settings : {CutSettings{1, 0.9f}, {3, 0.9f}, {12, 0.9f}, {12, 0}}) {
    for (const SegmentQuery& q : segments()) {
      const LightCut cut = selector->cut(q, settings);
      std::vector<double> count(41);
      for (int round = 0; round < kRounds; ++round) {
        for (const LightCandidate& c : selector->draw(cut, q, rng.uniform_wide())) {
          REQUIRE(c.n_pmf == doctest::Approx(selector->n_pmf(cut, q, c.light)).epsilon(1e-5).scale(0));
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
  CHECK(aside.cv2 == test::relative(12 / (3.0 * (100 - 3))).epsilon(0.02));
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
    const ConeLobe lobe = phase_lobe(g, {0, 0, 1});
    CHECK(lobe.axis.z == (g > 0 ? 1 : -1));
    const auto at = [&](double angle) { return phase_ratio(std::abs(g), std::cos(angle)); };
    CHECK(at(lobe.width) == doctest::Approx(0.5 * at(0)).epsilon(1e-3));
  }
  CHECK(phase_lobe(0, {0, 0, 1}).width == 0);
  CHECK(phase_lobe(0.1f, {0, 0, 1}).width == 0);  // half is nowhere
}

}  // namespace
}  // namespace tyndall
