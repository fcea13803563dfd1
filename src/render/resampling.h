/// Resampled importance sampling [Talbot et al. 2005].
#pragma once

#include <cmath>
#include <cstddef>

#include "math/small_vector.h"

namespace tyndall {

/// A candidate that is worth its shadow ray, and what its estimate is multiplied by.
struct Survivor {
  std::size_t index;
  float scale;
};
using Survivors = SmallVector<Survivor, 8>;

/// `count` of the candidates, drawn with replacement in proportion to their `weight`s > 0, stand for all [2005, eq. 4]:
/// the sum of scale x estimate is in expectation that over all candidates. Strata of one number `u` draw them.
/// 0, or no fewer than there are: every one. Weights that are not finite survive, for the film to count.
template <typename Candidates>
Survivors resample(const Candidates& candidates, int count, double u) {
  Survivors survivors;
  if (count == 0 || candidates.size() <= static_cast<std::size_t>(count)) {
    for (std::size_t i = 0; i < candidates.size(); ++i) survivors.push_back({i, 1});
    return survivors;
  }
  double total = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    total += candidates[i].weight;
    if (std::isfinite(candidates[i].weight)) continue;
    survivors.push_back({i, 1});
    return survivors;
  }
  std::size_t i = 0;
  double passed = candidates[0].weight;  // cumulative weight up to and with candidate i
  for (int k = 0; k < count; ++k) {
    const double target = (k + u) / count * total;
    while (passed <= target && i + 1 < candidates.size()) passed += candidates[++i].weight;
    survivors.push_back({i, static_cast<float>(total / (candidates[i].weight * static_cast<double>(count)))});
  }
  return survivors;
}

}  // namespace tyndall
