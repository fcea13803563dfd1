/// Random walks through media along a ray: where a path collides, and how much light gets through.
///
/// All estimators are unbiased. Coefficients of overlapping media add. Colour channels share one majorant (that of
/// the largest channel); their differences go into weights that stay bounded.
#pragma once

#include <cstdint>
#include <span>

#include "math/rng.h"
#include "tyndall/settings.h"
#include "volume/medium.h"
#include "volume/phase/phase_mix.h"

namespace tyndall {

/// The media that overlap on one interval of a ray; none is null.
using MediaView = std::span<const ParticipatingMedium* const>;

bool any_emissive(MediaView media);

/// Counters of one thread; add them up at the end.
struct TrackingStats {
  std::uint64_t lookups = 0;              ///< coefficients read at a point
  std::uint64_t noise_lookups = 0;        ///< those of procedural clouds, which cost more
  std::uint64_t segments = 0;             ///< pieces of constant majorant visited
  std::uint64_t majorant_violations = 0;  ///< lookups above the majorant: 0 unless there is a defect
  std::uint64_t caps_hit = 0;             ///< loops ended by their safety limit
};

/// Free flight along one interval.
struct Flight {
  bool collided = false;
  float t = 0;       ///< of the collision; the end of the interval if there was none
  Rgb weight{1.0f};  ///< multiplies the throughput. All zero after a collision: absorbed, the path ends
  PhaseMix phase;    ///< when collided and not absorbed
  float u_next = 0;  ///< when it passed: uniform in [0, 1), and stratified as the first was, for a flight from there
};

/// Sample the next collision in [t0, t1], t1 may be infinite. Survival biasing: a collision always scatters and
/// carries the albedo in its weight. `beta` is the throughput at t0; it steers the choices between channels and
/// nothing else. `u_first` is the random number of the first exponential step, [0, 1).
Flight free_flight(MediaView media, const Ray& ray, float t0, float t1, Rgb beta, float u_first, Rng& rng,
                   TrackingStats& stats);

/// How closely `raymarch` looks along shadow rays, and along segments that are marched once for all that is gathered there.
inline constexpr float kShadowSpacing = 0.5f, kSegmentSpacing = 0.25f;

/// An estimator of transmittance, and how closely it looks.
struct TransmittanceMethod {
  TransmittanceStrategy strategy;
  /// Of the look-ups of `raymarch` where nothing is attenuated yet, > 0, in optical depth that its controls may be wrong by.
  float spacing = kShadowSpacing;
};

/// Estimate exp(-integral of sigma_t over [t0, t1]); exact when all media are homogeneous.
Rgb transmittance(TransmittanceMethod method, MediaView media, const Ray& ray, float t0, float t1, Rng& rng,
                  TrackingStats& stats);

/// Unbiased estimate of exp(+integral of sigma_t over [t0, t1]), t1 finite, by ray marching at `spacing`, as above; exact when
/// all media are homogeneous. For what was reached with a probability that is a transmittance.
Rgb inverse_transmittance(float spacing, MediaView media, const Ray& ray, float t0, float t1, Rng& rng, TrackingStats& stats);

/// What a path makes of the emission that it passes.
class EmissionGauge {
 public:
  virtual ~EmissionGauge() = default;
  /// Of `emission`, the sum of sigma_a Le of `media` at `p`, what the path counts: its MIS weight times it.
  virtual Rgb counted(MediaView media, Vec3 p, Rgb emission) const = 0;
};

/// Who wants to know where on its way emission was found.
class EmissionSink {
 public:
  virtual ~EmissionSink() = default;
  /// A term of EmissionTransmittance::emitted, found at `t`.
  virtual void emitted(float t, Rgb light) = 0;
};

/// How emission is looked at on its way.
struct EmissionLook {
  const EmissionGauge* gauge = nullptr;  ///< null: all of it counts
  float density = 1;                     ///< look-ups for each unit of the majorant's optical depth, > 0
  EmissionSink* sink = nullptr;          ///< not told of what is known in closed form: homogeneous media without a gauge
};

/// Light emitted along an interval that reaches t0, and the transmittance of the whole interval.
struct EmissionTransmittance {
  Rgb emitted, transmittance;
};
/// Unbiased estimate of both, independent of where a path collides.
EmissionTransmittance emission_and_transmittance(MediaView media, const Ray& ray, float t0, float t1, const EmissionLook& look,
                                                 Rng& rng, TrackingStats& stats);

}  // namespace tyndall
