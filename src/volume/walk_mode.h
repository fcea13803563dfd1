/// What walks through media are for, and what they tell of the places that they read.
#pragma once

#include <algorithm>

#include "volume/tracking_kernel.h"

namespace tyndall {

/// What the pieces must bound. `majorant`: rate >= sigma_t. `regular`: likewise, in pieces that are gone through cell by cell.
/// `march`: rate >= |sigma_t - control|. `residual`: that times kOversampling, and bricks are walked by octants: both lower the
/// variance of residual tracking more than they cost, where a march gains more by more look-ups in fewer pieces.
enum class WalkMode { majorant, regular, residual, march };
inline constexpr bool subtracts_control(WalkMode mode) { return mode == WalkMode::residual || mode == WalkMode::march; }
inline constexpr float kOversampling = 1.7f;

/// Pieces of a smaller rate * length are not worth going through cell by cell: few rays collide there.
inline constexpr float kLeastRegular = 0.02f;

/// A node of the grid's tree is split further only while rate * length exceeds this: below it, walking the children
/// costs more than the look-ups it would save. Finer pieces lower the variance where a control is subtracted; a march gets
/// that for less by more look-ups.
template <WalkMode Mode>
inline constexpr float kRefineDepth = Mode == WalkMode::majorant  ? 1.0f
                                      : Mode == WalkMode::regular ? kLeastRegular
                                      : Mode == WalkMode::march   ? 0.5f
                                                                  : 0.125f;

/// A brick is walked by octants where its rate * length exceeds this; residual only.
inline constexpr float kSplitDepth = 0.1f;

/// Sigma and emission at a point, in 1/world unit and radiance/world unit.
struct LocalOptics {
  Rgb sigma_a, sigma_s;
  Rgb emission;  ///< sigma_a * Le; filled only on request

  Rgb sigma_t() const { return sigma_a + sigma_s; }
};

/// Places at even distances on a ray, in one piece of its walk.
struct Teeth {
  double t, apart;
  int count;  ///< > 0
};

/// sigma_t minus control of several teeth.
struct ExcessSum {
  Rgb sum;
  float largest = 0;  ///< of one tooth and channel, either sign
};

/// Read one by one.
template <typename Walk>
ExcessSum sum_of_each(Walk& walk, const Teeth& teeth) {
  ExcessSum result;
  for (int i = 0; i < teeth.count; ++i) {
    const Rgb excess = walk.excess_at(teeth.t + i * teeth.apart);
    result.sum += excess;
    result.largest = std::max(result.largest, kernel::max_abs(excess));
  }
  return result;
}

}  // namespace tyndall
