/// The phase function at a collision, where media may overlap.
#pragma once

#include <cmath>
#include <optional>

#include "math/small_vector.h"
#include "volume/phase/phase.h"

namespace tyndall {

/// Phase functions weighted by the scattering coefficients of their media, per channel:
/// p(wo, wi) = sum_i sigma_s,i p_i(wo, wi) / sum_i sigma_s,i. Equal phase functions share a lobe.
class PhaseMix {
 public:
  struct MixSample {
    Vec3 wi;     ///< unit, leaves the vertex
    Rgb weight;  ///< eval / pdf; 1 where there is one lobe
    float pdf;   ///< 1/sr, of the whole mixture
  };

  PhaseMix() = default;
  /// `phase` must outlive it.
  void add(Rgb sigma_s, const Phase& phase);  ///< zero sigma_s is left out
  void add(Rgb sigma_s, const Phase&& phase) = delete;
  bool empty() const { return lobes_.empty(); }
  std::size_t lobe_count() const { return lobes_.size(); }
  const Phase& phase(std::size_t lobe) const { return *lobes_[lobe].phase; }
  /// Probability that sample() chooses it; 0 of all where it gives nothing.
  float chance(std::size_t lobe, Rgb beta) const;

  /// Value per channel, 1/sr. A channel that does not scatter gives 0.
  Rgb eval(Vec3 wo, Vec3 wi) const;
  /// Density in 1/sr with which sample() chooses wi for throughput `beta`.
  float pdf(Vec3 wo, Vec3 wi, Rgb beta) const;
  /// A lobe by `uc` with probability proportional to sum over channels of |beta| sigma_s,i / sum_j sigma_s,j; then
  /// a direction of it by `u`. `beta` is the throughput that the direction will be weighted with; nothing if every
  /// channel that scatters has zero throughput.
  std::optional<MixSample> sample(Vec3 wo, Rgb beta, float uc, Vec2 u) const;

  /// sigma_s-weighted mean cosine, the mean of the channels; for heuristics.
  float mean_cosine() const;

 private:
  struct Lobe {
    Rgb sigma_s;
    const Phase* phase;
  };
  float lobe_mass(const Lobe& lobe, Rgb beta) const;

  SmallVector<Lobe, 4> lobes_;
  Rgb total_;  ///< sum of sigma_s
};

}  // namespace tyndall
