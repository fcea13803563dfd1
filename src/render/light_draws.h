/// The lights that next-event estimation tries.
#pragma once

#include <algorithm>

#include "light/selection.h"
#include "render/sampler.h"

namespace tyndall {

/// Nothing: the draw fell on lights that cannot contribute. `pmf`: how often that light is tried by the whole cut, on
/// average.
using LightDraws = SmallVector<std::optional<SelectedLight>, 16>;

/// All candidates of a cut. One number gives all selections in a cluster: the i-th of n lies in the i-th n-th of [0, 1),
/// so that they spread.
template <typename Query>
LightDraws draw_lights(const LightSelector& selector, const LightCut& cut, const Query& query, Sampler& sampler) {
  constexpr double kBelowOne = 0x1.fffffffffffffp-1;
  SmallVector<double, 16> numbers;
  LightDraws draws;
  for (const LightCluster& cluster : cut) {
    const double u = sampler.next_wide();
    for (std::uint32_t i = 0; i < cluster.candidates; ++i) {
      numbers.push_back(std::min((i + u) / cluster.candidates, kBelowOne));
      draws.push_back(std::nullopt);
    }
  }
  selector.select_all(cut, query, {numbers.data(), numbers.size()}, {draws.data(), draws.size()});
  std::size_t at = 0;
  for (const LightCluster& cluster : cut) {
    for (std::uint32_t i = 0; i < cluster.candidates; ++i, ++at) {
      if (draws[at]) draws[at]->pmf *= static_cast<float>(cluster.candidates);
    }
  }
  return draws;
}

}  // namespace tyndall
