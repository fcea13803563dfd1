#pragma once

#include "render/counters.h"
#include "render/sampler.h"
#include "render/world_parts.h"

namespace tyndall {

/// What light estimation needs of the render at large.
struct LightContext {
  const World::Parts& world;
  const LightSelector& selector;
  const RenderSettings& settings;
  Sampler& sampler;
  Counters& counters;
  bool emission_counts = true;  ///< of media, on the ray after the event at hand: not after a path's last one
};

}  // namespace tyndall
