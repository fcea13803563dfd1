/// Unbiased ray marching: transmittance from optical depths that are marched, corrected now and then.
#pragma once

#include <array>
#include <cmath>

#include "math/small_vector.h"
#include "volume/tracking_kernel.h"
#include "volume/walk_mode.h"

namespace tyndall::kernel {

/// T = exp(-control) exp(-x), x = E[X_i] for independent estimates X_0 .. X_N of the optical depth that the walk's controls
/// leave. With each X_i as the pivot in turn [Kettunen et al. 2021, eq. 10]:
///   exp(-x) = E[ 1/(N+1) sum_i exp(-X_i) sum_{k<=N} w_k / k! m_k({X_i - X_j}, j != i) ],  w_k = 1 / P(N >= k),
/// m_k the mean of all products of k of the N differences. N is 0 most of the time: that is plain ray marching.
/// Departures from the paper: the comb of an X_i has teeth spaced in optical depth of the walk's rate instead of length, so
/// that they are where the medium varies and nothing about the ray needs to be known beforehand, wider apart the more the
/// control has attenuated what is left to estimate; and N has a geometric tail, whose weights keep the variance finite however
/// far the X_i lie apart.
///
/// Of 1/T the same with all signs turned: exp(x) = exp(X_i) exp(x - X_i). Then nothing is given up, as nothing is negligible,
/// and N is never 0: a correction that is rare weighs much, and where T is small there is nothing that hides it.
class RayMarch {
 public:
  enum class Of { transmittance, inverse };
  RayMarch(Of of, float spacing, Rng& rng, TrackingStats& stats)
      : sign_(of == Of::inverse ? 1.0f : -1.0f),
        more_(of == Of::inverse ? 1.0f : kMore),
        base_spacing_(spacing),
        orders_(draw_orders(rng, stats)) {
    for (int i = 0; i <= orders_; ++i) combs_.push_back({double{rng.uniform()}, {}});
  }

  /// A piece of the walk. False: little enough is left to be given up; the estimate is 0.
  template <typename Walk>
  bool add(Walk& walk, Rng& rng, TrackingStats& stats) {
    const double length = walk.t_end() - walk.t();
    const float rate = walk.rate();
    if (rate > 0) {
      // Known before any look-up, so that it does not depend on what they read. A single tooth of what roulette left
      // must not bring back all that the control took: there it grows no more.
      const float attenuated = sign_ < 0 ? std::min({control_.r, control_.g, control_.b, kThick}) : 0.0f;
      spacing_ = base_spacing_ * (1 + attenuated);
      const double end = marched_ + rate * length / spacing_;
      if (!read_teeth(walk, end, rng, stats)) return false;
      marched_ = end;
    }
    control_ += depth_of(walk.control(), length);
    return survives_roulette(control_, rng);
  }

  Rgb estimate() const { return {estimate(0), estimate(1), estimate(2)}; }

 private:
  static constexpr float kMore = 0.05f;     // P(N >= 1), of transmittances
  static constexpr float kEvenMore = 0.5f;  // P(N >= k + 1 | N >= k)
  static constexpr int kMostOrders = 63;    // 2^-62 of the corrections would need more

  struct Comb {
    double tooth;  // next, as marched_
    Rgb x;
  };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  int draw_orders(Rng& rng, TrackingStats& stats) const {
    if (rng.uniform() >= more_) return 0;
    int orders = 1;
    while (orders < kMostOrders && rng.uniform() < kEvenMore) ++orders;
    if (orders == kMostOrders) ++stats.caps_hit;
    return orders;
  }

  /// The teeth in the current piece; false as add(). Combs are read side by side: roulette knows as much of each.
  ///
  /// Roulette inside a piece goes by the control up to the tooth, not to the piece's end: from there on a control may
  /// stand for what turns out to be clear, and the few who survive would weigh exp(what it was too much). As teeth read
  /// at least -control, a comb's optical depth up to a tooth is more than that at the end by a spacing at most.
  template <typename Walk>
  bool read_teeth(Walk& walk, double end, Rng& rng, TrackingStats& stats) {
    const double apart = spacing_ / walk.rate();
    for (;;) {
      double first = end;
      for (const Comb& comb : combs_) first = std::min(first, comb.tooth);
      if (!(first < end)) return true;
      const int count = guard_.fitting(std::ceil(end - first));
      const double to = std::min(end, first + count);
      for (Comb& comb : combs_)
        if (comb.tooth < to) read(comb, std::min(count, static_cast<int>(std::ceil(to - comb.tooth))), walk, stats);
      if (guard_.spent(stats, count)) return false;
      const double passed = (first - marched_ + count - 1) * apart;
      if (guard_.roulette_is_due() && !survives_roulette(control_ + depth_of(walk.control(), passed), rng)) return false;
    }
  }

  template <typename Walk>
  void read(Comb& comb, int count, Walk& walk, TrackingStats& stats) {
    const double apart = spacing_ / walk.rate();
    const ExcessSum excess = walk.excess_at(Teeth{walk.t() + (comb.tooth - marched_) * apart, apart, count});
    count_lookups(count, excess.largest, walk.rate(), stats);
    comb.x += excess.sum * (spacing_ / walk.rate());
    comb.tooth += count;
  }

  /// On exp of what is known so far, `control` and the comb that has found least: any function of the past will do, but those
  /// who survive what one comb has found would weigh that much in what another has not.
  bool survives_roulette(Rgb control, Rng& rng) {
    if (sign_ > 0) return true;
    float least = kInfinity;
    for (int i = 0; i <= orders_; ++i) {
      for (int channel = 0; channel < 3; ++channel) least = std::min(least, control[channel] + combs_[index(i)].x[channel]);
    }
    const float left = least - relief_;
    if (!(left > kThick)) return true;
    const float chance = std::exp(kThick - left);
    if (rng.uniform() >= chance) return false;
    relief_ += left - kThick;
    return true;
  }

  float estimate(int channel) const {
    double sum = 0;
    for (int pivot = 0; pivot <= orders_; ++pivot) {
      const double depth = double{control_[channel]} + combs_[index(pivot)].x[channel];
      sum += std::exp(double{relief_} + double{sign_} * depth) * series(pivot, channel);
    }
    return static_cast<float>(sum / (orders_ + 1));
  }

  /// sum_k w_k / k! m_k around one pivot, with the elementary symmetric sums e_k of the differences: m_k = e_k / (N over k).
  double series(int pivot, int channel) const {
    if (orders_ == 0) return 1;
    std::array<double, kMostOrders + 1> e{1};
    int count = 0;
    for (int i = 0; i <= orders_; ++i) {
      if (i == pivot) continue;
      const double difference = double{sign_} * (double{combs_[index(i)].x[channel]} - combs_[index(pivot)].x[channel]);
      ++count;
      for (int k = count; k > 0; --k) e[index(k)] += difference * e[index(k - 1)];
    }
    double sum = 1, factor = 1 / double{more_};
    for (int k = 1; k <= orders_; ++k) {
      factor /= orders_ - k + 1;  // w_k / k! / (N over k) = w_k (N - k)! / N!
      sum += factor * e[index(k)];
      factor /= kEvenMore;
    }
    return sum;
  }

  float sign_;          // of the optical depth in the exponent
  float more_;          // P(N >= 1)
  float base_spacing_;  // of the teeth where nothing is attenuated yet
  LoopGuard guard_;     // of one comb; the others have as many teeth
  int orders_;
  float spacing_ = 0;   // in the current piece, in optical depth of the rate
  double marched_ = 0;  // before the current piece, in teeth
  Rgb control_;
  float relief_ = 0;            // log of the weight that roulette gave
  SmallVector<Comb, 4> combs_;  // orders_ + 1
};

template <typename Walk>
Rgb ray_marching(Walk& walk, RayMarch::Of of, float spacing, Rng& rng, TrackingStats& stats) {
  RayMarch march(of, spacing, rng, stats);
  while (walk.next())
    if (!march.add(walk, rng, stats)) return {};
  return march.estimate();
}

}  // namespace tyndall::kernel
