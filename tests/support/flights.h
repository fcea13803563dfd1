/// Many free flights along one ray, against integration along it.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>

#include "support/test_media.h"
#include "volume/tracking.h"

namespace tyndall::test {

inline const Ray kDiagonal{{-1.3f, -0.9f, -1.1f}, normalize({1.1f, 0.8f, 0.9f})};
inline constexpr float kT1 = 4;
inline constexpr int kBins = 16;

struct Exact {
  double scattered[kBins][3] = {};  // integral of T sigma_s over the bin
  double through[3] = {}, emitted[3] = {};
};

inline Exact exact_flight(MediaView media, const Ray& ray, float t1) {
  Exact exact;
  double depth[3] = {};
  constexpr int kSteps = 32000;
  const double dt = double{t1} / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 p = ray.at(static_cast<float>((i + 0.5) * dt));
    Rgb sigma_a, sigma_s, emission;
    for (const ParticipatingMedium* medium : media) {
      const Coefficients k = medium->at(p);
      sigma_a += k.sigma_a;
      sigma_s += k.sigma_s;
      emission += k.sigma_a * k.Le;
    }
    for (int c = 0; c < 3; ++c) {
      const double step = (double{sigma_a[c]} + sigma_s[c]) * dt;
      const double T = std::exp(-depth[c] - 0.5 * step);
      exact.scattered[i * kBins / kSteps][c] += T * sigma_s[c] * dt;
      exact.emitted[c] += T * emission[c] * dt;
      depth[c] += step;
    }
  }
  for (int c = 0; c < 3; ++c) exact.through[c] = std::exp(-depth[c]);
  return exact;
}

struct Flown {
  std::array<std::array<Moments, 3>, kBins> scattered;
  std::array<Moments, 3> through, emitted;
  double heaviest = 0;
  TrackingStats stats;
};

inline Flown fly(MediaView media, const Ray& ray, float t1, Rgb beta, int count, decltype(free_flight)* flies = free_flight) {
  Flown flown;
  Rng rng(99);
  for (int i = 0; i < count; ++i) {
    const Flight flight = flies(media, ray, 0, t1, beta, rng.uniform(), rng, flown.stats);
    const int bin = std::min(kBins - 1, static_cast<int>(flight.t / t1 * kBins));
    const Rgb carried = flight.weight * beta;
    flown.heaviest = std::max(flown.heaviest, double{carried.r} + carried.g + carried.b);
    for (int c = 0; c < 3; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      for (int b = 0; b < kBins; ++b)
        flown.scattered[static_cast<std::size_t>(b)][channel].add(flight.collided && b == bin ? flight.weight[c] : 0.0f);
      flown.through[channel].add(flight.collided ? 0.0f : flight.weight[c]);
    }
    const EmissionTransmittance passed = emission_and_transmittance(media, ray, 0, t1, {}, rng, flown.stats);
    for (int c = 0; c < 3; ++c) flown.emitted[static_cast<std::size_t>(c)].add(passed.emitted[c]);
  }
  return flown;
}

inline void check_flight(const std::string& name, MediaView media, Rgb beta, int count = 60000,
                         decltype(free_flight)* flies = free_flight) {
  const Exact exact = exact_flight(media, kDiagonal, kT1);
  const Flown flown = fly(media, kDiagonal, kT1, beta, count, flies);
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    if (beta[c] == 0) continue;
    const auto channel = static_cast<std::size_t>(c);
    const double slack = 1.0 / count;
    for (std::size_t b = 0; b < kBins; ++b)
      worst =
          std::max(worst, flown.scattered[b][channel].deviation(exact.scattered[b][c], slack + 1e-3 * exact.scattered[b][c]));
    worst = std::max(worst, flown.through[channel].deviation(exact.through[c], slack));
    if (exact.emitted[c] > 0)
      worst = std::max(worst, flown.emitted[channel].deviation(exact.emitted[c], 1e-4 * exact.emitted[c]));
  }
  // 51 comparisons a call.
  CHECK_MESSAGE(worst < 4.5, name << ": " << worst << " standard errors");
  CHECK_MESSAGE(flown.stats.majorant_violations == 0, name);
  CHECK_MESSAGE(flown.stats.caps_hit == 0, name);
  CHECK_MESSAGE(flown.heaviest <= (double{beta.r} + beta.g + beta.b) * 1.001, name);
}

}  // namespace tyndall::test
