#include "volume/tracking.h"

#include <algorithm>
#include <cmath>

#include "volume/delta_tracking.h"
#include "volume/homogeneous.h"
#include "volume/merged_walk.h"
#include "volume/tracking_kernel.h"

namespace tyndall {

namespace {

using namespace kernel;

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
  FlightState state(beta, t1, u_first);
  if (media.empty() || !(t0 < t1) || is_black(state.beta)) return state.flight;
  if (all_homogeneous(media)) {
    ++stats.segments;
    return homogeneous_flight(media, t0, t1, state.beta, u_first, rng);
  }
  state.depth = exponential(u_first);
  return with_walk<WalkMode::majorant>(media, ray, t0, t1, stats, [&](auto& walk) {
    while (walk.next())
      if (walk.rate() > 0 && fly_through(walk, state.depth, state, rng, stats)) return state.flight;
    state.flight.u_next = uniform_of(state.depth);
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
