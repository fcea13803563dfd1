/// What the tracking loops share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/rng.h"
#include "volume/tracking.h"

namespace tyndall::kernel {

/// Weights below this are left to Russian roulette.
inline constexpr float kRouletteBelow = 0.01f;
inline constexpr float kThick = 4.6f;  ///< -ln kRouletteBelow
/// ... but only once in so many look-ups: it saves time in thick media, and only adds noise to short walks.
inline constexpr std::uint64_t kRouletteEvery = 16;
/// Look-ups of one walk, of one comb where it reads several, after which it is given up and counted. A path through an optical
/// depth of 1e7 needs fewer.
inline constexpr std::uint64_t kMaxLookups = std::uint64_t{1} << 26;

inline float max_abs(Rgb c) { return max_component(absolute(c)); }

/// Optical depth of a segment of constant sigma; where that is 0 the segment may be infinitely long.
inline Rgb depth_of(Rgb sigma, double length) {
  const auto depth = [&](float s) { return s > 0 ? static_cast<float>(s * length) : 0.0f; };
  return {depth(sigma.r), depth(sigma.g), depth(sigma.b)};
}

/// Exponential variate of rate 1, by a number of 24 bits: its difference from 1 is exact.
inline float exponential(float u) { return -std::log(1 - u); }
inline float exponential(Rng& rng) { return exponential(rng.uniform()); }
/// Its inverse: the rest of such a variate that is beyond some depth is one itself.
inline float uniform_of(double exponential) {
  return std::min(static_cast<float>(-std::expm1(-exponential)), kOneMinusEpsilon);
}

/// Slack of the rounding of sums over media.
inline void count_lookups(int count, float value, float bound, TrackingStats& stats) {
  stats.lookups += static_cast<std::uint64_t>(count);
  if (value > bound * (1 + 1e-6f)) ++stats.majorant_violations;
}
inline void count_lookup(float value, float bound, TrackingStats& stats) { count_lookups(1, value, bound, stats); }

/// Counts the look-ups of one walk.
class LoopGuard {
 public:
  bool spent(TrackingStats& stats, int more = 1) {
    count_ += static_cast<std::uint64_t>(more);
    if (count_ < kMaxLookups) return false;
    ++stats.caps_hit;
    return true;
  }
  /// Of `wanted` look-ups those until roulette is due.
  int fitting(double wanted) const {
    return static_cast<int>(std::min(wanted, static_cast<double>(kRouletteEvery - count_ % kRouletteEvery)));
  }
  bool roulette_is_due() const { return count_ % kRouletteEvery == 0; }

 private:
  std::uint64_t count_ = 0;
};

/// False: T is done with (and black). Keeps the mean of T.
inline bool roulette(Rgb& T, Rng& rng) {
  const float left = max_abs(T);
  if (left >= kRouletteBelow) return true;
  if (rng.uniform() * kRouletteBelow >= left) {
    T = {};
    return false;
  }
  T *= kRouletteBelow / left;
  return true;
}

/// Poisson points along the walk, of a density `density` times rate(): body(t, that density) for each, which scales down T;
/// ends when that is 0.
template <typename Walk, typename Body>
void for_each_collision(Walk& walk, Rgb& T, Rng& rng, TrackingStats& stats, const Body& body, float density = 1) {
  LoopGuard guard;
  float depth = exponential(rng);
  while (walk.next()) {
    const float rate = walk.rate() * density;
    if (!(rate > 0)) continue;
    double t = walk.t();
    for (;;) {
      const double step = static_cast<double>(depth) / rate;
      if (t + step >= walk.t_end()) {
        depth = std::max(0.0f, depth - static_cast<float>(rate * (walk.t_end() - t)));
        break;
      }
      t += step;
      body(t, rate);
      if (is_black(T)) return;
      if (guard.spent(stats)) {
        T = {};
        return;
      }
      if (guard.roulette_is_due() && !roulette(T, rng)) return;
      depth = exponential(rng);
    }
  }
}

}  // namespace tyndall::kernel
