#include "volume/tracking.h"

#include <algorithm>
#include <cmath>

#include "volume/homogeneous.h"
#include "volume/merged_walk.h"
#include "volume/tracking_kernel.h"

namespace tyndall {

namespace {

using namespace kernel;

/// Throughput relative to the largest channel at the start, so that products neither under- nor overflow.
Rgb normalised(Rgb beta) {
  const float top = max_abs(beta);
  return top > 0 ? Rgb{beta.r / top, beta.g / top, beta.b / top} : Rgb{};
}

/// State of a flight between its tentative collisions.
struct FlightState {
  Rgb beta;         // normalised
  float depth = 0;  // optical depth of the majorant still to go
  Flight flight;
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

/// Weighted delta tracking with survival biasing over pieces of constant majorant.
template <typename Walk>
void fly(Walk& walk, FlightState& state, Rng& rng, TrackingStats& stats) {
  LoopGuard guard;
  while (walk.next()) {
    const float rate = walk.rate();
    if (!(rate > 0)) continue;
    double t = walk.t();
    for (;;) {
      const double step = static_cast<double>(state.depth) / rate;
      if (t + step >= walk.t_end()) {
        state.depth = std::max(0.0f, state.depth - static_cast<float>(rate * (walk.t_end() - t)));
        break;
      }
      t += step;
      if (collide(walk, t, state, rng, stats)) return;
      state.depth = exponential(rng);
      if (guard.spent(stats)) {
        state.flight.weight = {};
        state.flight.collided = true;
        state.flight.t = static_cast<float>(t);
        return;
      }
    }
  }
}

/// Where emission is read on its way, and what counts of it.
struct Passing {
  MediaView media;
  const Ray& ray;
  const EmissionLook& look;
  bool emissive;

  Rgb counted(double t, Rgb emission) const {
    return look.gauge && !is_black(emission) ? look.gauge->counted(media, ray.at(static_cast<float>(t)), emission) : emission;
  }
};

/// Sum of emission and product of (1 - sigma_t / M) over tentative collisions: ratio tracking [Novak et al. 2014].
template <typename Walk>
void gather(Walk& walk, const Passing& passing, EmissionTransmittance& result, Rng& rng, TrackingStats& stats) {
  const auto look = [&](double t, float rate) {
    const LocalOptics at = looked_up(walk, t, passing.emissive, rate, stats);
    const Rgb emitted = result.transmittance * passing.counted(t, at.emission) * (1 / rate);
    result.emitted += emitted;
    if (passing.look.sink) passing.look.sink->emitted(static_cast<float>(t), emitted);
    result.transmittance *= Rgb{1.0f} - at.sigma_t() * (1 / rate);
  };
  for_each_collision(walk, result.transmittance, rng, stats, look, passing.look.density);
}

}  // namespace

bool any_emissive(MediaView media) {
  return std::any_of(media.begin(), media.end(), [](const ParticipatingMedium* m) { return m->emissive(); });
}

// NOLINTNEXTLINE(readability-function-size): one caller, once a span; a struct would be filled to be emptied
Flight free_flight(MediaView media, const Ray& ray, float t0, float t1, Rgb beta, float u_first, Rng& rng,
                   TrackingStats& stats) {
  FlightState state{normalised(beta), 0, {}};
  state.flight.t = t1;
  if (media.empty() || !(t0 < t1) || is_black(state.beta)) return state.flight;
  if (all_homogeneous(media)) {
    ++stats.segments;
    return homogeneous_flight(media, t0, t1, state.beta, u_first, rng);
  }
  // A channel without throughput stays without: its weights mean nothing and must not overflow.
  state.flight.weight = {state.beta.r == 0 ? 0.0f : 1.0f, state.beta.g == 0 ? 0.0f : 1.0f, state.beta.b == 0 ? 0.0f : 1.0f};
  state.depth = exponential(u_first);
  return with_walk<WalkMode::majorant>(media, ray, t0, t1, stats, [&](auto& walk) {
    fly(walk, state, rng, stats);
    return state.flight;
  });
}

// NOLINTNEXTLINE(readability-function-size): as free_flight
EmissionTransmittance emission_and_transmittance(MediaView media, const Ray& ray, float t0, float t1, const EmissionLook& look,
                                                 Rng& rng, TrackingStats& stats) {
  EmissionTransmittance result{{}, Rgb{1.0f}};
  if (media.empty() || !(t0 < t1)) return result;
  if (all_homogeneous(media)) {
    ++stats.segments;
    const UniformOptics m = sum_of(media);
    const double length = double{t1} - t0;
    if (is_black(m.emission)) return {{}, m.transmittance(length)};
    return {look.gauge ? homogeneous_emission(media, ray, t0, t1, *look.gauge, rng) : m.emitted(length),
            m.transmittance(length)};
  }
  const Passing passing{media, ray, look, any_emissive(media)};
  return with_walk<WalkMode::majorant>(media, ray, t0, t1, stats, [&](auto& walk) {
    gather(walk, passing, result, rng, stats);
    return result;
  });
}

}  // namespace tyndall
