/// The cheapest cut of a set of lights by the surface area orientation heuristic, found on buckets along the three axes.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "light/build_light.h"

namespace tyndall {

/// The lights' centres along one axis, cut into equal buckets.
struct BucketGrid {
  static constexpr int kBuckets = 16;
  int axis = 0;
  float low = kInfinity, high = -kInfinity, per_length = 0;

  /// Twice the light's centre.
  static float place(const BuildLight& light, int axis) { return light.low[axis] - light.minus_high[axis]; }

  bool flat() const { return per_length == 0; }
  int of(const BuildLight& light) const {
    return std::clamp(static_cast<int>((place(light, axis) - low) * per_length), 0, kBuckets - 1);
  }
};

struct BucketCut {
  BucketGrid grid;
  int last = 0;                  ///< bucket of the first side
  double first = 0, second = 0;  ///< what the heuristic says of the two sides

  bool on_first_side(const BuildLight& light) const { return grid.of(light) <= last; }
};

/// Nothing: their centres do not tell the lights apart.
std::optional<BucketCut> best_cut(std::span<const BuildLight> lights);

}  // namespace tyndall
