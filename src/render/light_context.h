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
  int event = 0;  ///< scattering events of the path before the one at hand
};

/// What the ray after it meets counts no more, but for lights.
inline bool is_last_event(const LightContext& context) { return context.event + 1 >= context.settings.max_depth; }

/// It is the only one of its path.
inline bool is_only_event(const LightContext& context) { return context.event == 0 && is_last_event(context); }

}  // namespace tyndall
