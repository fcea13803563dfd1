/// Next-event estimation at a vertex.
#pragma once

#include "transport/vertex/directions.h"

namespace tyndall {

/// How lights are sampled at one vertex: direct_light uses it, and MIS must know it when a scattered ray hits one.
struct LightSearch {
  const LightSelector* among = nullptr;  ///< the lights that are sought; null: there are none
  bool volumes = false;                  ///< media that emit are among them
  PointQuery query;
  LightCut cut;
  int shadow_rays = 0;  ///< to trace, 0: to all candidates
};
LightSearch light_search(const LightContext& context, const Vertex& vertex);

/// Unbiased estimate of the light scattered at `vertex` toward the path, weighted by MIS against scattered rays that hit
/// emitters. Candidates are chosen and evaluated without visibility; some are traced, resampled by their contribution
/// (resampling.h); light_counts.h says how many.
/// Multiply by the throughput `beta`, which is passed for the densities only.
Rgb direct_light(const LightContext& context, const Directions& directions, const LightSearch& search, Rgb beta);

}  // namespace tyndall
