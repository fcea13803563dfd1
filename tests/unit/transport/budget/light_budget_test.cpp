#include "transport/budget/light_trial.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "math/rng.h"

namespace tyndall {
namespace {

constexpr LightBudget kDuring{{8, 4}, {3, 2}};

PerSpent<int> numbers(const LightBudget& b) {
  return {{b.vertex.candidates, b.vertex.shadow_rays, b.span.candidates, b.span.shadow_rays}};
}

/// Variance of one of each, and what it costs.
struct Truth {
  PerSpent<double> variance, cost;
  double other_variance, other_cost;

  double product(const PerSpent<double>& n) const {
    double v = other_variance, c = other_cost;
    for (std::size_t i = 0; i < kSpents; ++i) v += variance[i] / n[i], c += cost[i] * n[i];
    return v * c;
  }
  Trials tried() const {
    Trials trials{.all_variance = other_variance, .all_cost = other_cost};
    const auto n = numbers(kDuring);
    for (std::size_t i = 0; i < kSpents; ++i) {
      trials.all_variance += trials.variance[i] = variance[i] / n[i];
      trials.all_cost += trials.cost[i] = cost[i] * n[i];
    }
    return trials;
  }
};

/// By trying every step of a twentieth up and down, one number after the other, until none helps.
double least_product(const Truth& truth) {
  PerSpent<double> n{{8, 4, 3, 2}};
  for (bool better = true; better;) {
    better = false;
    for (double& x : n) {
      for (const double step : {1.05, 1 / 1.05}) {
        const double before = truth.product(n), old = x;
        x = std::fmin(64, std::fmax(2, x * step));
        if (truth.product(n) < before * (1 - 1e-9))
          better = true;
        else
          x = old;
      }
    }
  }
  return truth.product(n);
}

}  // namespace

// Rounding to whole numbers costs 2 % at most, from 2.45 to 2; that of several adds up.
TEST_CASE("the budget's variance x cost is the least that a search finds") {
  Rng rng(7);
  const auto any = [&](double middle) { return middle * std::exp2(6 * double{rng.uniform()} - 3); };
  for (int i = 0; i < 200; ++i) {
    const Truth truth{{{any(4), any(4), any(4), any(4)}}, {{any(0.1), any(0.1), any(0.1), any(0.1)}}, any(2), any(4)};
    const auto best = numbers(best_budget(truth.tried(), kDuring));
    PerSpent<double> n;
    for (std::size_t k = 0; k < kSpents; ++k) n[k] = best[k];
    if (best[0] == best[1] || best[2] == best[3]) continue;  // candidates were raised to the rays
    CHECK(truth.product(n) <= 1.05 * least_product(truth));
  }
}

TEST_CASE("more variance asks for more, a higher price for less, and doubt for little of either") {
  const Truth truth{{{4, 4, 4, 4}}, {{0.1, 0.1, 0.1, 0.1}}, 2, 4};
  const auto rays = [](const Trials& trials) { return best_budget(trials, kDuring).vertex.shadow_rays; };
  Truth noisy = truth, dear = truth;
  noisy.variance[Spent::vertex_rays] *= 9;
  dear.cost[Spent::vertex_rays] *= 4;
  const int usual = rays(truth.tried());
  CHECK(rays(noisy.tried()) > 2 * usual);
  CHECK(rays(dear.tried()) < usual);
  Trials doubtful = noisy.tried();
  doubtful.trust = 0.5;
  CHECK(rays(doubtful) < rays(noisy.tried()));
  doubtful.trust = 0;
  CHECK(rays(doubtful) == kDuring.vertex.shadow_rays);
}

// A render whose choices are made with other numbers, as many rays as candidates, of which nothing is left to chance.
TEST_CASE("choices keep what they leave to chance beside what else another look has found") {
  const Truth truth{{{4, 4, 4, 4}}, {{0.1, 0.1, 0.1, 0.1}}, 2, 4};
  Truth other = truth;
  other.other_variance = 11, other.other_cost = 3;
  Trials others{{{0.5, 0, 0.5, 0}}, {{1, 2, 1, 2}}, 11 + 1, 3 + 6, 0.7};
  const Trials both = beside(truth.tried(), others), expected = other.tried();
  CHECK(both.variance == expected.variance);
  CHECK(both.cost == expected.cost);
  CHECK(both.all_variance == doctest::Approx(expected.all_variance));
  CHECK(both.all_cost == doctest::Approx(expected.all_cost));
  CHECK(both.trust == truth.tried().trust);
}

TEST_CASE("whatever trials say, there are 2 to 64 of each, and no more rays than candidates") {
  const double bad[] = {
      0, -1, 1e-300, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()};
  for (const double v : bad) {
    for (const double c : bad) {
      for (const double all : bad) {
        const Trials trials{{{v, v, all, 1}}, {{c, c, c, all}}, all, all, 1};
        const LightBudget b = best_budget(trials, kDuring);
        for (const LightCounts counts : {b.vertex, b.span}) {
          CHECK(counts.shadow_rays >= 2);
          CHECK(counts.candidates >= counts.shadow_rays);
          CHECK(counts.candidates <= 64);
        }
      }
    }
  }
}

// Terms 1, 2, 3, 4 and chances of a half and more: the sum of terms / chance has a known variance.
TEST_CASE("survivors tell the variance of their sum") {
  Rng rng(3);
  constexpr int kTerms = 12, kTrials = 20000;
  double told = 0, sum = 0, squares = 0;
  for (int i = 0; i < kTrials; ++i) {
    SumOfTerms terms;
    double total = 0;
    for (int k = 0; k < kTerms; ++k) {  // independent and alike: how many survive is given
      const double term = 2.0 * (1 + double{rng.uniform()}) * (rng.uniform() < 0.5f);
      terms.add(term, 2);
      total += term;
    }
    told += terms.variance();
    sum += total;
    squares += total * total;
  }
  const double variance = squares / kTrials - (sum / kTrials) * (sum / kTrials);
  CHECK(told / kTrials == doctest::Approx(variance).epsilon(0.04));  // four standard errors
  SumOfTerms alone;
  alone.add(6, 3);
  CHECK(alone.variance() == doctest::Approx(24));  // 8, as a term of 2 with a chance of 1/3 has it, over that chance
}

}  // namespace tyndall
