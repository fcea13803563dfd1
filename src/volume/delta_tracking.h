/// Weighted delta tracking with survival biasing, piece by piece of a walk.
#pragma once

#include "volume/merged_walk.h"
#include "volume/tracking_kernel.h"

namespace tyndall::kernel {

/// Throughput relative to the largest channel at the start, so that products neither under- nor overflow.
inline Rgb normalised(Rgb beta) {
  const float top = max_abs(beta);
  return top > 0 ? Rgb{beta.r / top, beta.g / top, beta.b / top} : Rgb{};
}

/// State of a flight between its collisions, real and null.
struct FlightState {
  /// A channel without throughput stays without: its weights mean nothing and must not overflow.
  FlightState(Rgb throughput, float t1, float u_first) : beta(normalised(throughput)) {
    flight.t = t1;
    flight.u_next = u_first;
    flight.weight = {beta.r == 0 ? 0.0f : 1.0f, beta.g == 0 ? 0.0f : 1.0f, beta.b == 0 ? 0.0f : 1.0f};
  }

  Rgb beta;         // normalised
  float depth = 0;  // optical depth still to go: of the majorant, or as it is
  Flight flight;
  LoopGuard guard;
};

/// A tentative collision at t. True when the flight ends there.
///
/// Real and null are chosen with probabilities proportional to sum_c |b_c| sigma_t,c and sum_c |b_c| |M - sigma_t,c|,
/// b the throughput with all weights of this walk so far: the balance heuristic over channels, so that the sum of |b|
/// never grows. Written with absolute values and the true total it stays unbiased where sigma_t exceeds M.
template <typename Walk>
bool collide(Walk& walk, double t, FlightState& state, Rng& rng, TrackingStats& stats) {
  Flight& flight = state.flight;
  const float rate = walk.rate();
  const LocalOptics at = looked_up(walk, t, false, rate, stats);
  const Rgb sigma_t = at.sigma_t();

  // Where nothing scatters a collision would only end the path: weigh instead, until too little is left.
  if (is_black(at.sigma_s)) {
    flight.weight *= Rgb{1.0f} - sigma_t * (1 / rate);
    const float left = max_abs(state.beta * flight.weight);
    if (left >= kRouletteBelow) return false;
    if (rng.uniform() * kRouletteBelow < left) {
      flight.weight *= kRouletteBelow / left;
      return false;
    }
    flight.weight = {};
    flight.collided = true;
    flight.t = static_cast<float>(t);
    return true;
  }

  const Rgb null{rate - sigma_t.r, rate - sigma_t.g, rate - sigma_t.b};
  const Rgb b = absolute(state.beta * flight.weight);
  const float real_mass = sum(b * sigma_t), null_mass = sum(b * absolute(null));
  const float total = real_mass + null_mass;
  if (rng.uniform() * total < real_mass) {
    flight.weight *= at.sigma_s * (total / (rate * real_mass));
    flight.collided = true;
    flight.t = static_cast<float>(t);
    walk.add_phase(flight.phase);
    return true;
  }
  flight.weight *= null * (total / (rate * null_mass));
  return false;
}

/// Through the current piece, with `depth` of its majorant still to go; less what is passed. True when the flight ends there.
template <typename Walk>
bool fly_through(Walk& walk, float& depth, FlightState& state, Rng& rng, TrackingStats& stats) {
  const float rate = walk.rate();
  for (double t = walk.t();;) {
    const double step = static_cast<double>(depth) / rate;
    if (t + step >= walk.t_end()) {
      depth = std::max(0.0f, depth - static_cast<float>(rate * (walk.t_end() - t)));
      return false;
    }
    t += step;
    if (collide(walk, t, state, rng, stats)) return true;
    depth = exponential(rng);
    if (state.guard.spent(stats)) {
      state.flight.weight = {};
      state.flight.collided = true;
      state.flight.t = static_cast<float>(t);
      return true;
    }
  }
}

}  // namespace tyndall::kernel
