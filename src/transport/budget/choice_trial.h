/// How a trial sees one choice among lights.
#pragma once

#include "transport/budget/light_trial.h"
#include "transport/budget/prices.h"

namespace tyndall {

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
  LightTrial* const trial = context.bounce == 0 ? context.trial : nullptr;
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
