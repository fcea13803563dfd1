/// What Lights is made of. Only src/light sees it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "light/delta_lights.h"
#include "light/emitter.h"
#include "light/environment.h"
#include "light/instanced_emitters.h"
#include "light/lights.h"
#include "light/portal.h"
#include "light/profile_emitter.h"
#include "light/profile_library.h"

namespace tyndall {

struct Lights::Parts {
  enum class Kind : std::uint32_t { point, spot, profile, distant, environment, portal, emitter, volume, instanced };
  /// Where a light is to be found: eight bytes, since there may be millions.
  struct Reference {
    Kind kind : 4;
    std::uint32_t index : 28;  ///< into the vector of its kind
    std::uint32_t primitive = 0;
  };

  double power(LightId light) const;  ///< W, mean of the channels; 0: it can never contribute
  /// Lights of instances come last, and are found through the instances.
  Reference find(LightId light) const { return light < lights.size() ? lights[light] : Reference{Kind::instanced, 0, 0}; }

  std::vector<Reference> lights;
  std::vector<PointEmitter> points;
  std::vector<SpotEmitter> spots;
  std::vector<ProfileEmitter> profiles;
  ProfileLibrary profile_library;  ///< what `profiles` refer to
  std::vector<DistantEmitter> distants;
  std::vector<Environment> environments;
  std::vector<Portal> portals;
  std::vector<Emitter> emitters;     ///< by emitter shape
  std::vector<LightId> first_light;  ///< of each emitter shape
  std::vector<LightId> infinite;
  std::size_t even_skies = 0;
  Lights::Far far;
  std::vector<VolumeEmitter> volumes;
  InstancedEmitters instanced;
  std::size_t instanced_lights = 0;
  EmissionMaps maps;
  double scene_radius = 1;
  Bounds3 near_box, point_box;
  double near_power = 0;
  std::vector<SelectorStats> selector_stats;
  std::vector<std::unique_ptr<const LightSelector>> selectors;  ///< as in selector_stats
  /// The same without the volumes; empty where there are none.
  std::vector<std::unique_ptr<const LightSelector>> selectors_of_surfaces;
  LightStats stats;
};

}  // namespace tyndall
