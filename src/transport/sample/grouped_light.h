/// The light of one sample, light group by light group.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "transport/world/light_groups.h"
#include "tyndall/math.h"

namespace tyndall {

/// Kept beside the sums of all light, which do not know of it: same numbers drawn, same choices, same bits.
/// LightContext::groups points to it where the scene has groups.
///
/// An estimator adds what it counts of each light to an estimate, in its own unit, and whoever multiplies its result by a
/// throughput settles the estimate by the same factor.
class GroupedLight {
 public:
  using Sums = std::vector<Rgb>;  ///< by group

  explicit GroupedLight(const LightGroups& groups) : found(groups.size()), groups_(groups), estimate_(groups.size()) {}

  Sums found;  ///< radiance of the sample
  Sums own;    ///< PathOffer::own

  const LightGroups& groups() const { return groups_; }

  void estimate(LightId light, Rgb contribution) {
    estimate_[groups_.of(light)] += contribution;
    estimated_ = true;
  }
  void settle(Rgb factor, Sums& into) {
    if (!estimated_) return;
    add(factor, estimate_, into);
    std::fill(estimate_.begin(), estimate_.end(), Rgb());
    estimated_ = false;
  }
  static void add(Rgb factor, const Sums& light, Sums& into) {
    for (std::size_t g = 0; g < light.size(); ++g) {
      if (!is_black(light[g])) into[g] += factor * light[g];
    }
  }

  /// While an offer is completed `found` is of its last find; back.
  Sums begin_find() {
    own.assign(found.size(), Rgb());
    return std::exchange(found, Sums(found.size()));
  }
  Sums end_find(Sums found_before) { return std::exchange(found, std::move(found_before)); }

  void scale(float s) {
    for (Rgb& light : found) light *= s;
  }

 private:
  const LightGroups& groups_;
  Sums estimate_;
  bool estimated_ = false;
};

}  // namespace tyndall
