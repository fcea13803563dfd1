/// Closed forms for media that are the same everywhere.
#pragma once

#include <span>

#include "volume/tracking.h"

namespace tyndall {

/// The sum of homogeneous media.
struct UniformOptics {
  Rgb sigma_a, sigma_s;
  Rgb emission;  ///< sum of sigma_a * Le
  Rgb sigma_t() const { return sigma_a + sigma_s; }

  /// exp(-sigma_t d); d may be infinite.
  Rgb transmittance(double d) const;
  /// Light emitted along a length d that reaches its near end: emission * (1 - exp(-sigma_t d)) / sigma_t.
  Rgb emitted(double d) const;
};

bool all_homogeneous(MediaView media);
UniformOptics sum_of(MediaView media);

/// What passes a length d of media: the transmittance, and the probability that homogeneous_flight() does not collide.
struct UniformPassage {
  Rgb transmittance{1.0f};
  float probability = 1;
};
UniformPassage passage_of(MediaView media, double d, Rgb beta);

/// `beta` with its largest channel 1.
Flight homogeneous_flight(MediaView media, double t0, double t1, Rgb beta, float u_first, Rng& rng);
/// Unbiased estimate of the emission along [t0, t1] that reaches t0 and that `gauge` counts, by one point.
Rgb homogeneous_emission(MediaView media, const Ray& ray, double t0, double t1, const EmissionGauge& gauge, Rng& rng);

}  // namespace tyndall
