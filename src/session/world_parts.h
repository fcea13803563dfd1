/// What a World is made of. Only src/session sees it.
#pragma once

#include <cstdint>

#include "session/unit_scene.h"
#include "transport/world/built_world.h"

namespace tyndall {

struct World::Parts {
  Parts(UnitScene unit_scene, const BuildSettings& settings, std::size_t volume_memory);  ///< as BuiltWorld's

  BuildSummary summary;    ///< before `built`, which fills it
  Transform to_user;       ///< from the renderer's own units to the space of the scene as it was given
  float unit;              ///< length there of 1 here
  CameraRays user_camera;  ///< the camera as it was given, for what images say of it
  BuiltWorld built;        ///< in the renderer's own units
  std::uint64_t scene_hash = 0;
};

}  // namespace tyndall
