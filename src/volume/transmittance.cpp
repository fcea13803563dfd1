/// The estimators of transmittance; all share the walk over pieces and differ in what a collision does.
#include <cmath>

#include "volume/homogeneous.h"
#include "volume/merged_walk.h"
#include "volume/ray_march.h"

namespace tyndall {
namespace {

using namespace kernel;

/// T = E[prod (1 - sigma_t / M)] [Novak et al. 2014].
template <typename Walk>
Rgb ratio_tracking(Walk& walk, Rng& rng, TrackingStats& stats) {
  Rgb T{1.0f};
  for_each_collision(walk, T, rng, stats, [&](double t, float rate) {
    T *= Rgb{1.0f} - looked_up(walk, t, false, rate, stats).sigma_t() * (1 / rate);
  });
  return T;
}

/// A real collision gives 0. Channels share the choice, as in free_flight.
template <typename Walk>
Rgb delta_tracking(Walk& walk, Rng& rng, TrackingStats& stats) {
  Rgb T{1.0f};
  for_each_collision(walk, T, rng, stats, [&](double t, float rate) {
    const Rgb sigma_t = looked_up(walk, t, false, rate, stats).sigma_t();
    const Rgb null = Rgb{rate} - sigma_t;
    const float real_mass = sum(absolute(T) * sigma_t), null_mass = sum(absolute(T * null));
    const float total = real_mass + null_mass;
    const bool real = rng.uniform() * total < real_mass || null_mass == 0;
    T = real ? Rgb{} : T * null * (total / (rate * null_mass));
  });
  return T;
}

/// State of a residual walk: T * exp(-optical depth) is the estimate so far.
struct Residual {
  Rgb T{1.0f}, depth;
  Rgb value() const { return T * exp(depth * -1.0f); }

  /// On the whole estimate; T alone may be large where controls took most.
  bool survives_roulette(Rng& rng) {
    const float left = max_abs(value());
    if (left >= kRouletteBelow) return true;
    if (rng.uniform() * kRouletteBelow >= left) return false;
    T *= kRouletteBelow / left;
    return true;
  }
};

/// T = exp(-int c) E[prod (1 - (sigma_t - c) / M_r)], M_r >= |sigma_t - c|: residual ratio tracking
/// [Novak et al. 2014] with a control c for each piece, chosen by MediumWalk.
template <typename Walk>
Rgb residual_ratio_tracking(Walk& walk, Rng& rng, TrackingStats& stats) {
  LoopGuard guard;
  Residual state;
  float next = exponential(rng);
  while (walk.next()) {
    const float rate = walk.rate();
    state.depth += depth_of(walk.control(), walk.t_end() - walk.t());
    if (!(rate > 0)) continue;

    double t = walk.t();
    for (;;) {
      const double step = static_cast<double>(next) / rate;
      if (t + step >= walk.t_end()) {
        next = std::max(0.0f, next - static_cast<float>(rate * (walk.t_end() - t)));
        break;
      }
      t += step;
      const Rgb excess = walk.excess_at(t);
      count_lookup(max_abs(excess), rate / kOversampling, stats);
      state.T *= Rgb{1.0f} - excess * (1 / rate);
      if (guard.spent(stats)) return {};
      next = exponential(rng);
      if (guard.roulette_is_due() && !state.survives_roulette(rng)) return {};
    }
    // Where the control takes most, few look-ups are made. Media that are exact (rate 0) never come here.
    if (std::min({state.depth.r, state.depth.g, state.depth.b}) > kThick && !state.survives_roulette(rng)) return {};
  }
  return state.value();
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): as free_flight
Rgb transmittance(TransmittanceMethod method, MediaView media, const Ray& ray, float t0, float t1, Rng& rng,
                  TrackingStats& stats) {
  if (media.empty() || !(t0 < t1)) return Rgb{1.0f};
  if (all_homogeneous(media)) {
    ++stats.segments;
    return sum_of(media).transmittance(double{t1} - t0);
  }
  const TransmittanceStrategy strategy = method.strategy;
  if (strategy == TransmittanceStrategy::raymarch) {
    return with_walk<WalkMode::march>(media, ray, t0, t1, stats, [&](auto& walk) {
      return ray_marching(walk, RayMarch::Of::transmittance, method.spacing, rng, stats);
    });
  }
  if (strategy == TransmittanceStrategy::residual) {
    return with_walk<WalkMode::residual>(media, ray, t0, t1, stats,
                                         [&](auto& walk) { return residual_ratio_tracking(walk, rng, stats); });
  }
  return with_walk<WalkMode::majorant>(media, ray, t0, t1, stats, [&](auto& walk) {
    return strategy == TransmittanceStrategy::ratio ? ratio_tracking(walk, rng, stats) : delta_tracking(walk, rng, stats);
  });
}

// NOLINTNEXTLINE(readability-function-size): as free_flight
Rgb inverse_transmittance(float spacing, MediaView media, const Ray& ray, float t0, float t1, Rng& rng, TrackingStats& stats) {
  if (media.empty() || !(t0 < t1)) return Rgb{1.0f};
  if (all_homogeneous(media)) {
    ++stats.segments;
    return exp(sum_of(media).sigma_t() * (t1 - t0));
  }
  return with_walk<WalkMode::march>(media, ray, t0, t1, stats,
                                    [&](auto& walk) { return ray_marching(walk, RayMarch::Of::inverse, spacing, rng, stats); });
}

}  // namespace tyndall
