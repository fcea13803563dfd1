/// Light found beyond the first bounce, shared by the paths of neighbouring pixels [Bekaert et al. 2002].
///
/// Neighbours see much the same, yet each path looks in one direction. What its ray from the first vertex meets, a diffuse
/// surface or a collision in a medium, is connected to the first vertices of the other paths too, which might have met it as
/// well: each find counts for all of them, weighted by the balance heuristic [Veach 1997] over the densities, or proxies of
/// them, with which any would have met it. A connection costs a shadow ray whatever it brings: finds that are worth little play
/// roulette.
#pragma once

#include <span>

#include "transport/path.h"

namespace tyndall {

/// Most paths that share.
inline constexpr std::size_t kMostSharing = 64;

/// What connections go through, how, and where they are counted.
struct Between {
  const BuiltWorld& world;
  TransmittanceStrategy transmittance;
  Counters& counters;
};

/// Hands out what the offers of `paths` are worth to each of them: at most kMostSharing, all with complete offers.
void share_suffixes(const Between& between, std::span<Path* const> paths);

}  // namespace tyndall
