/// Directions by the product of a phase function and a lobe.
#pragma once

#include "math/rng.h"
#include "volume/phase/phase.h"

namespace tyndall {

/// Henyey and Greenstein's form around `axis`, of mean cosine `bundled` in [0, 1).
struct DirectionLobe {
  Vec3 axis;
  float bundled;
};

/// Drawn exactly in proportion to phase(wo, wi) lobe(wi), by rejection.
Vec3 sample_product(const Phase& phase, Vec3 wo, const DirectionLobe& lobe, Rng& rng);

}  // namespace tyndall
