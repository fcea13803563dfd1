#include "transport/techniques/resampling.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
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
    for (const Survivor& s : resample(candidates, count, (i + 0.5f) / kSteps)) sum += s.scale * candidates[s.index].estimate;
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

TEST_CASE("resampling: heavy ones for sure, others in proportion to their weight, as many as asked for") {
  const std::vector<Candidate> candidates{{1, 1}, {6, 1}, {3, 1}};
  constexpr int kSteps = 1000;
  int first = 0;
  for (int i = 0; i < kSteps; ++i) {
    const Survivors two = resample(candidates, 2, (i + 0.5f) / kSteps);
    REQUIRE(two.size() == 2);
    const Survivor &heavy = two[two[0].index == 1 ? 0 : 1], &other = two[two[0].index == 1 ? 1 : 0];
    CHECK(heavy.index == 1);
    CHECK(heavy.scale == 1);
    CHECK(other.scale == (other.index == 0 ? doctest::Approx(4) : doctest::Approx(4.0 / 3)));
    first += other.index == 0;
  }
  CHECK(first == kSteps / 4);
}

TEST_CASE("resampling: the chance to survive is min(1, w / c)") {
  // With c from another way to find it: halving.
  Rng rng(2);
  for (int size = 2; size <= 12; ++size) {
    std::vector<Candidate> candidates = random_candidates(size, rng);
    for (Candidate& c : candidates) c.weight = std::pow(c.weight, 8.0f);
    for (int count = 1; count < std::min(size, 6); ++count) {
      double low = 0, high = 1e6;
      for (int step = 0; step < 100; ++step) {
        const double c = 0.5 * (low + high);
        double kept = 0;
        for (const Candidate& candidate : candidates) kept += std::min(1.0, candidate.weight / c);
        (kept > count ? low : high) = c;
      }
      constexpr int kSteps = 20'000;
      std::vector<int> survived(candidates.size());
      for (int i = 0; i < kSteps; ++i) {
        for (const Survivor& s : resample(candidates, count, (i + 0.5f) / kSteps)) ++survived[s.index];
      }
      CAPTURE(size);
      CAPTURE(count);
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        CHECK(std::abs(double(survived[i]) / kSteps - std::min(1.0, candidates[i].weight / high)) <= 2.0 / kSteps);
      }
    }
  }
}

TEST_CASE("resampling: ends with equal weights beside one next to nothing") {
  // The threshold falls onto the weights that are equal to it, and off them again by rounding.
  const std::vector<Candidate> two{{1, 1}, {0.5f, 1}, {0.5f, 1}, {0x1.8p-53f, 1}},
      three{{1, 1}, {1, 1}, {0.5f, 1}, {0.5f, 1}, {0x1p-52f, 1}};
  CHECK(resample(two, 2, 0.3f).size() == 2);
  CHECK(resample(three, 3, 0.3f).size() == 3);
}

TEST_CASE("resampling: thousands of candidates of every size a float has") {
  Rng rng(3);
  std::vector<Candidate> candidates{{0x1p-126f, 1}};
  while (candidates.size() < 30'000) candidates.push_back({std::exp2(252 * rng.uniform() - 126), 1});
  for (const int count : {1, 100, 4096}) {
    for (const float u : {0.0f, 0.3f, kOneMinusEpsilon}) {
      const Survivors survivors = resample(candidates, count, u);
      REQUIRE(survivors.size() == static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < survivors.size(); ++i) {
        REQUIRE(survivors[i].scale >= 1);
        REQUIRE(std::isfinite(survivors[i].scale));
        REQUIRE((i == 0 || survivors[i].index > survivors[i - 1].index));
      }
    }
  }
}

TEST_CASE("resampling: every one where there are no more than asked for") {
  const std::vector<Candidate> candidates{{1, 1}, {6, 1}, {1, 1}};
  for (const int count : {0, 3, 8}) {
    const Survivors all = resample(candidates, count, 0.3f);
    REQUIRE(all.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(all[k].index == k);
      CHECK(all[k].scale == 1);
    }
  }
}

TEST_CASE("resampling: a weight that is no number survives, for the film to count") {
  for (const float weight : {kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
    const std::vector<Candidate> candidates{{1, 1}, {weight, 1}, {1, 1}};
    for (const float u : {0.0f, 0.4f, 0.999f}) {
      const Survivors survivors = resample(candidates, 1, u);
      REQUIRE(survivors.size() == 1);
      CHECK(survivors[0].index == 1);
      CHECK(survivors[0].scale == 1);
    }
  }
}
