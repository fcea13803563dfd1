/// What a World is made of. Only src/render sees it.
#pragma once

#include <vector>

#include "light/lights.h"
#include "render/camera_ray.h"
#include "render/fire_lights.h"
#include "render/media_glow.h"
#include "render/media_state.h"
#include "render/near_lamps.h"
#include "render/pixel_filter.h"
#include "render/span_walk.h"
#include "render/unit_scene.h"
#include "surface/geometry.h"
#include "surface/material.h"
#include "texture/textures.h"
#include "tyndall/render.h"
#include "volume/medium.h"

namespace tyndall {

struct World::Parts {
  Parts(UnitScene unit_scene, const BuildSettings& settings, std::size_t volume_memory);  ///< bytes that volume files may take
  Parts(const Parts&) = delete;                                                           // its members refer to each other

  BuildSummary summary;    ///< first: the others fill it while they are built
  Scene scene;             ///< in the renderer's own units, as everything here
  Transform to_user;       ///< to the space of the scene as it was given
  float unit;              ///< length there of 1 here
  CameraRays user_camera;  ///< the camera as it was given, for what images say of it
  Textures textures;
  Materials materials;
  Geometry geometry;
  std::vector<ParticipatingMedium> media;
  FireLights fire;  ///< empty unless asked for
  bool has_fire;    ///< it was
  Lights lights;
  NearLamps near_lamps;              ///< where all media are unbounded, or all lamps far, of no place
  MediaGlow glow;                    ///< empty where all media are homogeneous
  std::vector<LightId> first_light;  ///< by placed shape; kNone where it does not emit
  CameraRays camera;
  FilterSampler filter;
  MediaState camera_media;  ///< what holds the camera's center
  std::uint64_t scene_hash = 0;

  SpanWalk::Context media_context() const { return {geometry.groups(), media}; }
  /// No medium anywhere: nothing of src/volume needs to run.
  bool has_media() const { return !media.empty(); }
  MaterialId material_of(const SurfaceHit& hit) const { return geometry.placed()[hit.shape].shape->material; }
  /// Whether there are lights that a ray can find, at its end: surfaces that shine, and skies.
  bool rays_find_lights() const { return lights.stats().emitters > 0 || !lights.infinite().empty(); }
  /// The light that the hit primitive is, if it emits.
  std::optional<LightId> light_of(const SurfaceHit& hit) const {
    const LightId first = first_light[hit.shape];
    if (first == kNone) return std::nullopt;
    return first + hit.primitive;
  }
};

}  // namespace tyndall
