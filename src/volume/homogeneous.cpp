#include "volume/homogeneous.h"

#include <algorithm>
#include <cmath>

#include "volume/medium_data.h"
#include "volume/tracking_kernel.h"

namespace tyndall {
namespace {

float attenuation(float sigma, double d) { return sigma > 0 ? static_cast<float>(std::exp(-sigma * d)) : 1.0f; }

float emitted_channel(float emission, float sigma, double d) {
  if (emission == 0) return 0;
  return static_cast<float>(emission * (sigma > 0 ? -std::expm1(-sigma * d) / sigma : d));
}

/// A channel by the throughput it carries.
int choose_channel(Rgb mass, float u) {
  const float pick = u * sum(mass);
  if (pick < mass.r) return 0;
  if (pick < mass.r + mass.g || mass.b == 0) return mass.g > 0 ? 1 : 0;
  return 2;
}

}  // namespace

Rgb UniformOptics::transmittance(double d) const {
  const Rgb s = sigma_t();
  return {attenuation(s.r, d), attenuation(s.g, d), attenuation(s.b, d)};
}

Rgb UniformOptics::emitted(double d) const {
  const Rgb s = sigma_t();
  return {emitted_channel(emission.r, s.r, d), emitted_channel(emission.g, s.g, d), emitted_channel(emission.b, s.b, d)};
}

bool all_homogeneous(MediaView media) {
  for (const ParticipatingMedium* medium : media)
    if (!medium->homogeneous()) return false;
  return true;
}

UniformOptics sum_of(MediaView media) {
  UniformOptics sum;
  for (const ParticipatingMedium* medium : media) {
    const MediumData& m = medium->data();
    sum.sigma_a += m.optics.sigma_a;
    sum.sigma_s += m.optics.sigma_s;
    if (m.emission.kind != EmissionField::Kind::none) sum.emission += m.optics.sigma_a * m.emission.at({});
  }
  return sum;
}

UniformPassage passage_of(MediaView media, double d, Rgb beta) {
  const UniformOptics m = sum_of(media);
  UniformPassage passage{m.transmittance(d)};
  const Rgb mass = absolute(beta);
  const float total = sum(mass);
  if (is_black(m.sigma_s) || !(total > 0)) return passage;  // weighed, never ended
  const Rgb passed = mass * passage.transmittance;
  passage.probability = sum(passed) / total;
  return passage;
}

/// The distance is drawn from the exponential of one channel and weighted by the density over all channels:
/// p(t) = sum_c P_c sigma_c exp(-sigma_c t), P_c proportional to |beta_c|.
// NOLINTNEXTLINE(readability-function-size): as free_flight
Flight homogeneous_flight(MediaView media, double t0, double t1, Rgb beta, float u_first, Rng& rng) {
  const UniformOptics m = sum_of(media);
  const double length = t1 - t0;
  Flight flight;
  flight.t = static_cast<float>(t1);
  flight.u_next = u_first;
  if (is_black(m.sigma_s)) {
    flight.weight = m.transmittance(length);
    return flight;
  }

  const Rgb s = m.sigma_t();
  const bool grey = s.r == s.g && s.g == s.b;
  Rgb mass = absolute(beta);
  const float total = sum(mass);
  if (!(total > 0)) return flight;
  mass = mass * (1 / total);
  const float sigma = grey ? s.r : s[choose_channel(mass, rng.uniform())];
  const double depth = -std::log1p(-double{u_first});
  const double t = sigma > 0 ? depth / sigma : std::numeric_limits<double>::infinity();

  flight.collided = t < length;
  if (flight.collided) flight.t = static_cast<float>(t0 + t);
  if (sigma > 0 && !flight.collided) flight.u_next = kernel::uniform_of(depth - sigma * length);
  if (grey) {
    if (flight.collided) flight.weight = m.sigma_s * (1 / s.r);
  } else {
    const Rgb T = m.transmittance(flight.collided ? t : length);
    const Rgb density = flight.collided ? mass * s * T : mass * T;
    flight.weight = (flight.collided ? m.sigma_s * T : T) * (1 / sum(density));
  }
  if (flight.collided)
    for (const ParticipatingMedium* medium : media) flight.phase.add(medium->data().optics.sigma_s, medium->phase());
  return flight;
}

/// The point is distributed by the transmittance of the clearest channel, which bounds all weights.
Rgb homogeneous_emission(MediaView media, const Ray& ray, double t0, double t1, const EmissionGauge& gauge, Rng& rng) {
  const UniformOptics m = sum_of(media);
  const Rgb s = m.sigma_t();
  const double sigma = std::min({s.r, s.g, s.b}), length = t1 - t0, u = rng.uniform();
  const double reached = -std::expm1(-sigma * length);  // of the light from infinitely far, by that channel
  const double t = sigma > 0 ? -std::log1p(-u * reached) / sigma : u * length;
  if (!(t < std::numeric_limits<double>::infinity())) return {};
  const double per_density = sigma > 0 ? reached / sigma * std::exp(sigma * t) : length;
  return gauge.counted(media, ray.at(static_cast<float>(t0 + t)), m.emission) * m.transmittance(t) *
         static_cast<float>(per_density);
}

}  // namespace tyndall
