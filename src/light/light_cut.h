/// The clusters of lights that a vertex draws its candidates from.
#pragma once

#include <algorithm>
#include <cstdint>

#include "math/below_one.h"
#include "math/small_vector.h"

namespace tyndall {

struct LightCluster {
  std::uint32_t ref;  ///< what the strategy knows it by
  float candidates;   ///< to draw from it, on average; > 0
};

/// Disjoint clusters that hold every light which may contribute.
using LightCut = SmallVector<LightCluster, 16>;

/// Of a cluster, so that sums of these are finite.
inline constexpr float kMostImportance = 1e35f;

/// Makes of a cut whose clusters have their importance, at most kMostImportance, in place of candidates one that shares so many
/// candidates out by it.
inline void share_out(LightCut& cut, float candidates) {
  float total = 0;
  for (const LightCluster& c : cut) total += c.candidates;
  for (LightCluster& c : cut) c.candidates = candidates * (c.candidates / total);
}

/// How many candidates a cut has in all.
inline int candidates_of(const LightCut& cut) {
  float sum = 0;
  for (const LightCluster& c : cut) sum += c.candidates;
  return static_cast<int>(sum + 0.5f);
}

/// f(i, cluster, u) for every candidate i, by one number u in [0, 1): of n the i-th comes from the i-th n-th of the cut,
/// so that they spread. Gives the cluster, and a number in [0, 1) to go on with.
template <typename F>
void for_each_candidate(const LightCut& cut, double u, const F& f) {
  const int n = candidates_of(cut);
  double sum = 0;
  for (const LightCluster& c : cut) sum += c.candidates;
  const LightCluster* cluster = cut.begin();
  double before = 0;
  for (int i = 0; i < n; ++i) {
    const double at = (i + u) / n * sum;
    while (at >= before + cluster->candidates && cluster + 1 != cut.end()) before += (cluster++)->candidates;
    f(i, *cluster, std::min((at - before) / cluster->candidates, kBelowOne));
  }
}

/// What a cut may cost, and what is split.
struct CutSettings {
  int candidates = 1;   ///< in all; 0: as many as splitting makes clusters
  float splitting = 0;  ///< clusters with a lower score are split while candidates allow; 0: none, 1: down to single lights
  bool near_lights =
      false;  ///< at points, in place of `splitting`: whatever may hold a light that deserves a candidate is split
};

}  // namespace tyndall
