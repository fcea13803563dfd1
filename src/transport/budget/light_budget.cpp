#include "transport/budget/light_budget.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tyndall {
namespace {

constexpr double kLeast = 2, kMost = 64;
/// Of all variance: what is left of it without the choices' is a difference, which noise may make as small as it likes.
constexpr double kLeastRest = 0.05;

double sum(const PerSpent<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
double rest_of_cost(const Trials& trials) { return trials.all_cost - sum(trials.cost); }

}  // namespace

double rest_of_variance(const Trials& trials) {
  return std::max(trials.all_variance - sum(trials.variance), kLeastRest * trials.all_variance);
}

Trials beside(const Trials& choices, const Trials& others) {
  Trials trials = choices;
  trials.all_variance = sum(trials.variance) + rest_of_variance(others);
  trials.all_cost = sum(trials.cost) + rest_of_cost(others);
  return trials;
}

LightBudget best_budget(const Trials& trials, const LightBudget& during) {
  const double A = rest_of_variance(trials), C = rest_of_cost(trials);
  // Variance and cost were those of n together: B = n variance, c = cost / n.
  const auto best = [&](Spent spent, int n) {
    const double ratio = std::max(trials.variance[spent], 0.0) * C / (A * trials.cost[spent]);
    if (!(ratio >= 0 && std::isfinite(ratio))) return n;
    return static_cast<int>(std::lround(std::clamp(n * std::pow(ratio, 0.5 * trials.trust), kLeast, kMost)));
  };
  const auto both = [&](Spent candidates, Spent rays, LightCounts n) {
    const int shadow_rays = best(rays, n.shadow_rays);
    return LightCounts{std::max(best(candidates, n.candidates), shadow_rays), shadow_rays};
  };
  return {both(Spent::vertex_candidates, Spent::vertex_rays, during.vertex),
          both(Spent::span_candidates, Spent::span_rays, during.span), true, during.collisions_shared};
}

}  // namespace tyndall
