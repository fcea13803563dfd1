/// The state of a random walk between the two interfaces of a coated surface.
#pragma once

#include "math/rng.h"
#include "surface/layered.h"

namespace tyndall {

/// Height runs from 0 (bottom) to coat.thickness (top). `w` is the direction of travel, `beta` the throughput.
struct LayerWalk {
  enum class Event { scattering, bottom, top };

  const Coat& coat;
  Rng& rng;
  float eta;  ///< of the coat, to undo the 1/eta^2 of radiance in the roulette
  Vec3 w;
  Rgb beta;
  float z;

  /// Travel to the next bounce, through absorption or with a sampled distance when the coat scatters.
  Event advance();
  /// Russian roulette past the fourth bounce; 0 ends the walk, else the probability it went on with (beta is divided).
  float survive(int bounce);
  /// A new direction from the phase function; returns its density, 1/sr.
  float scatter();
  float phase(Vec3 direction) const;  ///< density of travelling on along `direction`, 1/sr
  /// Follow a lobe sample; w leaves the interface along it.
  void follow(const BsdfSample& s) {
    beta *= s.weight;
    w = s.wi;
  }
  /// Fraction that crosses a slab of `dz` along `direction`.
  static float transmittance(float dz, Vec3 direction) { return std::exp(-std::abs(dz / direction.z)); }
};

}  // namespace tyndall
