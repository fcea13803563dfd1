/// The clusters of lights that a vertex draws its candidates from.
#pragma once

#include <cstdint>

#include "math/small_vector.h"

namespace tyndall {

struct LightCluster {
  std::uint32_t ref;         ///< what the strategy knows it by
  std::uint32_t candidates;  ///< to draw from it, >= 1
};

/// Disjoint clusters that hold every light which may contribute.
using LightCut = SmallVector<LightCluster, 16>;

/// What a cut may cost.
struct CutSettings {
  int candidates = 1;   ///< in all; 0: as many as splitting makes clusters
  float splitting = 0;  ///< clusters with a lower score are split while candidates allow; 0: none, 1: down to single lights
};

}  // namespace tyndall
