/// Few of many candidates are evaluated in full: resampled importance sampling [Talbot et al. 2005], without replacement.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "math/small_vector.h"

namespace tyndall {

/// A candidate that is worth its shadow ray, and what its estimate is multiplied by.
struct Survivor {
  std::size_t index;
  float scale;
};
using Survivors = SmallVector<Survivor, 8>;

/// Which candidates are kept, and how the others are drawn.
struct Thinning {
  double threshold = std::numeric_limits<double>::infinity();  ///< weights from here up are kept
  int drawn = 0;                                               ///< of the others
};

/// Of `count` > 0 survivors among more candidates than that: one of weight w survives with probability min(1, w / c), where
/// the threshold c makes `count` of them. No other unbiased choice of so few has a smaller sum of the variances of weights
/// [Fearnhead and Clifford 2003; c is their 1/c].
template <typename Candidates>
Thinning thinning(const Candidates& candidates, int count) {
  Thinning found{.drawn = count};
  for (int kept_before = -1;;) {
    // The rest is summed anew: beside a heavy weight that is taken off again, light ones would be rounded away.
    int kept = 0;
    double rest = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double weight = candidates[i].weight;
      if (weight >= found.threshold)
        ++kept;
      else
        rest += weight;
    }
    found.drawn = count - kept;
    if (kept == kept_before || found.drawn == 0) return found;
    // It only falls, but for rounding: a weight that equals it would be kept now, now not, for ever.
    found.threshold = std::min(found.threshold, rest / found.drawn);
    kept_before = kept;
  }
}

/// `count` of the candidates, chosen by their `weight`s > 0, stand for all: the sum of scale x estimate is in expectation
/// that over all candidates. The heavy ones are kept as they are, strata of one number `u` in [0, 1), a multiple of 2^-24,
/// draw the others.
/// 0, or no fewer than there are: every one. A weight that is not finite survives, for the film to count.
template <typename Candidates>
Survivors resample(const Candidates& candidates, int count, float u) {
  Survivors survivors;
  if (count == 0 || candidates.size() <= static_cast<std::size_t>(count)) {
    for (std::size_t i = 0; i < candidates.size(); ++i) survivors.push_back({i, 1});
    return survivors;
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (std::isfinite(candidates[i].weight)) continue;
    survivors.push_back({i, 1});
    return survivors;
  }
  const auto [threshold, drawn] = thinning(candidates, count);
  const double middle = double{u} + 0x1p-25;  // of u's step: at 0 the first would be drawn, however light
  double passed = 0;                          // weight of those that were not kept, up to and with candidate i
  int k = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double weight = candidates[i].weight;
    if (weight >= threshold) {
      survivors.push_back({i, 1});
      continue;
    }
    passed += weight;
    if (k == drawn || passed <= (k + middle) * threshold) continue;
    survivors.push_back({i, static_cast<float>(threshold / weight)});
    ++k;
  }
  return survivors;
}

}  // namespace tyndall
