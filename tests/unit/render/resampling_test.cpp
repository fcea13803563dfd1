#include "render/resampling.h"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "math/rng.h"
#include "tyndall/math.h"

using namespace tyndall;

namespace {

struct Candidate {
  float weight;
  double estimate;  ///< what it stands for; need not be in proportion to the weight
};

std::vector<Candidate> random_candidates(int count, Rng& rng) {
  std::vector<Candidate> candidates;
  for (int i = 0; i < count; ++i) {
    const float weight = rng.uniform() + 0.05f;
    candidates.push_back({weight, 2 * double{rng.uniform()} - 0.5});
  }
  return candidates;
}

double sum_of_all(const std::vector<Candidate>& candidates) {
  double sum = 0;
  for (const Candidate& c : candidates) sum += c.estimate;
  return sum;
}

/// The mean over u of what the survivors stand for, by the midpoint rule.
double mean_of_survivors(const std::vector<Candidate>& candidates, int count) {
  constexpr int kSteps = 100'000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (const Survivor& s : resample(candidates, count, (i + 0.5) / kSteps)) sum += s.scale * candidates[s.index].estimate;
  }
  return sum / kSteps;
}

}  // namespace

TEST_CASE("resampling: survivors stand for the sum of all candidates on average") {
  Rng rng(1);
  for (int size = 1; size <= 7; ++size) {
    for (int count = 1; count <= 4; ++count) {
      CAPTURE(size);
      CAPTURE(count);
      const auto candidates = random_candidates(size, rng);
      CHECK(mean_of_survivors(candidates, count) == doctest::Approx(sum_of_all(candidates)).epsilon(5e-3));
    }
  }
}

TEST_CASE("resampling: as many as asked for, in strata, and every one where there are no more") {
  const std::vector<Candidate> candidates{{1, 1}, {6, 1}, {1, 1}};
  for (int i = 0; i < 100; ++i) {
    const double u = (i + 0.5) / 100;
    const Survivors two = resample(candidates, 2, u);
    REQUIRE(two.size() == 2);
    CHECK((two[0].index == 1 || two[1].index == 1));  // three quarters of the weight: in one of two strata for sure
    for (const int count : {0, 3, 8}) {
      const Survivors all = resample(candidates, count, u);
      REQUIRE(all.size() == 3);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(all[k].index == k);
        CHECK(all[k].scale == 1);
      }
    }
  }
}

TEST_CASE("resampling: a weight that is no number survives, for the film to count") {
  for (const float weight : {kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
    const std::vector<Candidate> candidates{{1, 1}, {weight, 1}, {1, 1}};
    for (const double u : {0.0, 0.4, 0.999}) {
      const Survivors survivors = resample(candidates, 1, u);
      REQUIRE(survivors.size() == 1);
      CHECK(survivors[0].index == 1);
      CHECK(survivors[0].scale == 1);
    }
  }
}
