/// What asking lights costs a path, and what it leaves to chance: noted where lights are asked, while a pilot looks
/// (session/pilot.h).
#pragma once

#include <algorithm>

#include "transport/budget/light_budget.h"
#include "transport/sample/light_context.h"
#include "transport/sample/prices.h"

namespace tyndall {

/// Sums over a path's samples.
struct LightTrial {
  PerSpent<double> variance{};  ///< that choices add to a sample's radiance (mean of the channels), given all else
  PerSpent<double> cost{};      ///< ns (Prices)
  // What was done a second time for the trial alone.
  double difference = 0;  ///< by how much more it found, in radiance
  double repeated = 0;    ///< ns
};

/// Terms that were drawn with a probability of 1 / scale each, times their scale.
class SumOfTerms {
 public:
  void add(double term, double scale) {
    sum_ += term;
    squares_ += term * term;
    alone_ = term * term * (1 - 1 / scale);
    ++count_;
  }
  /// Of their sum: n / (n - 1) times their squared deviations from the mean. One alone is there, or not.
  double variance() const {
    if (count_ < 2) return alone_;
    const auto n = static_cast<double>(count_);
    return std::max(squares_ - sum_ * sum_ / n, 0.0) * n / (n - 1);
  }

 private:
  double sum_ = 0, squares_ = 0, alone_ = 0;
  int count_ = 0;
};

/// Of all that the context's thread has counted.
inline double cost_so_far(const LightContext& context) { return Prices(context.world.lights.size()).of(context.counters); }

/// Shadow rays to the survivors of resampling. Made before they are traced.
class RayTrial {
 public:
  /// `trial` null: nothing is noted.
  RayTrial(const LightContext& context, LightTrial* trial) : context_(context), trial_(trial) {
    if (trial_) before_ = cost_so_far(context_);
  }
  /// What one of them found, times its `scale`. What is kept for certain has scale 1, and leaves nothing to chance.
  void add(Rgb light, float scale) {
    if (trial_ && scale > 1) drawn_.add(double{mean(light)}, double{scale});
  }
  /// After the last.
  void note(Spent rays) {
    if (!trial_) return;
    trial_->variance[rays] += drawn_.variance();
    trial_->cost[rays] += cost_so_far(context_) - before_;
  }

 private:
  const LightContext& context_;
  LightTrial* trial_;
  double before_ = 0;
  SumOfTerms drawn_;
};

/// Which numbers a choice is made with.
struct SpentOn {
  Spent candidates, rays;
};

/// estimate(context, trial) of light that is yet to be multiplied by `beta`. A trial has it made twice with fresh random
/// numbers: how the two differ tells the variance of one [unbiased: half their squared difference], of which the rays' share is
/// known.
template <typename Estimate>
Rgb tried(const LightContext& context, SpentOn spent, Rgb beta, const Estimate& estimate) {
  LightTrial* const trial = context.smooth_bounces == 0 ? context.trial : nullptr;
  if (!trial) return estimate(context, nullptr);
  const LightTrial before = *trial;
  const double begin = cost_so_far(context);
  const Rgb light = estimate(context, trial);
  const double end = cost_so_far(context);
  LightContext again = context;
  again.groups = nullptr;
  again.deep = nullptr;
  const auto difference = double{mean(beta * (estimate(again, nullptr) - light))};
  trial->variance[spent.candidates] +=
      0.5 * difference * difference - (trial->variance[spent.rays] - before.variance[spent.rays]);
  trial->cost[spent.candidates] += end - begin - (trial->cost[spent.rays] - before.cost[spent.rays]);
  trial->difference += difference;
  trial->repeated += cost_so_far(context) - end;
  return light;
}

}  // namespace tyndall
