/// Light of far sources as a medium spreads it around them: the sun's aureole in a cloud.
#pragma once

#include <array>
#include <cstddef>

#include "math/rng.h"
#include "math/simd.h"
#include "volume/phase/phase_mix.h"

namespace tyndall {

/// What a place in a medium receives of scattered light, roughly, by direction. Where light is scattered forward its ways stay
/// nearly straight, so that what arrives after m collisions has the phase function's m-th convolution around the source, and m
/// is distributed as Poisson's with the optical depth [Goudsmit and Saunderson 1940]: lobes of Henyey and Greenstein's form
/// around the source, with mean cosines g^m. The rest comes evenly from everywhere.
///
/// It guides paths: no estimate is made from it. Its product with any phase function is known in closed form and drawn exactly,
/// as weights of a path multiply over all its collisions.
class Aureole {
 public:
  static constexpr std::size_t kMostSources = 4;

  static constexpr int kMostOrders = 54;  ///< of scattering that have lobes

  /// Between the sources and the place.
  struct Medium {
    float g;                   ///< mean cosine
    float albedo;              ///< single scattering
    int orders = kMostOrders;  ///< of scattering, at most, that whoever asks can find
  };
  /// `fluence`, radiance integrated over directions, is what else arrives. `doubt`, at least 1, multiplies all that comes
  /// evenly: the more of it, the less is guided.
  Aureole(const Medium& medium, float fluence, float doubt = 1) : medium_(medium), doubt_(doubt), even_(doubt * fluence) {}

  struct Source {
    Vec3 direction;       ///< toward it
    float fluence;        ///< without the medium
    float bundled;        ///< mean cosine of its light around `direction`
    float optical_depth;  ///< up to it
  };
  /// At most kMostSources.
  void add(const Source& source);

  /// Some of it differs from even light by enough to guide by.
  bool shows() const;
  /// Arriving from `w`, of an unknown unit.
  float radiance(Vec3 w) const;
  /// Integral of radiance times phase function toward `wo`; `beta` chooses between lobes as in PhaseMix::pdf().
  float scattered(const PhaseMix& phase, Vec3 wo, Rgb beta) const;
  /// Density of sample() over that of the phase function.
  float pdf_ratio(const PhaseMix& phase, Vec3 wo, Vec3 wi, Rgb beta) const { return radiance(wi) / scattered(phase, wo, beta); }
  Vec3 sample(const PhaseMix& phase, Vec3 wo, Rgb beta, Rng& rng) const;

 private:
  static constexpr std::size_t kLobes = 8;
  struct Lobes {
    Vec3 axis;
    alignas(32) std::array<float, kLobes> fluence, bundled;
  };
  /// Of one source's lobes and one phase function, what is scattered where forward and axis are `below` = 1 - cosine apart.
  static Float8 products(const Lobes& lobes, const Phase& phase, float below);

  Medium medium_;
  float doubt_, even_;
  std::size_t count_ = 0;
  std::array<Lobes, kMostSources> sources_;  ///< the first count_
};

}  // namespace tyndall
