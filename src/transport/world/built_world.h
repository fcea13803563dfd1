/// The scene as light transport runs on it.
#pragma once

#include <vector>

#include "light/lights.h"
#include "surface/geometry.h"
#include "surface/material.h"
#include "texture/textures.h"
#include "transport/camera/camera_ray.h"
#include "transport/camera/pixel_filter.h"
#include "transport/media/media_state.h"
#include "transport/media/span.h"
#include "transport/world/bright_media.h"
#include "transport/world/light_distances.h"
#include "transport/world/light_groups.h"
#include "transport/world/suns.h"
#include "transport/world/volume_lights.h"
#include "tyndall/render.h"
#include "volume/medium.h"

namespace tyndall {

struct VolumeLimits {
  std::size_t memory;  ///< bytes that volume files may take
  double unit = 1;     ///< as MediumBuildOptions
};

/// Everything that a path may meet, in the units of the scene it was made from.
struct BuiltWorld {
  /// Fills its part of `summary`. Throws Error for what is wrong with the scene.
  BuiltWorld(Scene unit_scene, const BuildSettings& settings, const VolumeLimits& limits, BuildSummary& summary);
  BuiltWorld(const BuiltWorld&) = delete;  // its members refer to each other

  Scene scene;
  Textures textures;
  Materials materials;
  Geometry geometry;
  std::vector<ParticipatingMedium> media;
  CameraRays camera;
  FilterSampler filter;
  MediaState camera_media;     ///< what holds the camera's center, and what is unbounded
  VolumeLights volume_lights;  ///< empty unless asked for
  bool has_volume_lights;      ///< whether they were asked for
  Lights lights;
  LightDistances light_distances;    ///< empty where all media are unbounded, or all lights are far
  BrightMedia bright_media;          ///< empty where all media are homogeneous
  Suns suns;                         ///< empty where the scene has no sun
  LightGroups light_groups;          ///< empty where the scene names none
  bool has_panes = false;            ///< some surface lets light straight through
  std::vector<LightId> first_light;  ///< by placed shape; kNone where it does not emit

  SpanWalk::Context media_context() const { return {geometry.groups(), media}; }
  /// Membership where a ray of the camera begins, which is not the center of a lens or screen.
  MediaState media_at_start(Vec3 origin) const;
  /// No medium anywhere: nothing of src/volume needs to run.
  bool has_media() const { return !media.empty(); }
  bool media_emit;  ///< some medium does
  MaterialId material_of(const SurfaceHit& hit) const { return geometry.placed()[hit.shape].shape->material; }
  /// Whether there are lights that a ray can hit: emissive surfaces and environments.
  bool rays_find_lights() const { return lights.stats().emitters > 0 || !lights.infinite().empty(); }
  /// The light that the hit primitive is, if it emits.
  std::optional<LightId> light_of(const SurfaceHit& hit) const {
    const LightId first = first_light[hit.shape];
    if (first == kNone) return std::nullopt;
    return first + hit.primitive;
  }
};

/// What lights need to know of a hit of one of them.
inline EmitterHit emitter_hit(const SurfaceHit& hit) { return {.p = hit.p, .ng = hit.ng, .uv = hit.uv, .distance = hit.t}; }

}  // namespace tyndall
