#include "transport/world/built_world.h"

#include <algorithm>
#include <utility>

#include "transport/media/camera_media.h"
#include "transport/world/camera_place.h"
#include "tyndall/error.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

std::vector<ParticipatingMedium> build_media(const Scene& scene, const BuildSettings& settings, const VolumeLimits& limits,
                                             BuildSummary& summary) {
  const Timer watch;
  std::vector<ParticipatingMedium> media;
  media.reserve(scene.media.size());
  for (const Medium& medium : scene.media) {
    const std::size_t left = limits.memory - std::min(summary.volume_bytes, limits.memory);
    const MediumBuildOptions how{
        .sanitize = settings.sanitize, .most_memory = left, .kept = settings.kept, .unit = limits.unit};
    media.push_back(build_medium(medium, how, summary.notes));
    summary.volume_bytes += media.back().memory_bytes();
  }
  summary.media = media.size();
  summary.volume_seconds = watch.seconds();
  return media;
}

Geometry build_geometry(const Scene& scene, const Textures& textures, int threads, BuildSummary& summary) {
  const Timer watch;
  Geometry geometry(scene, &textures, threads);
  summary.triangles = geometry.triangle_count();
  summary.geometry_bytes = geometry.memory_bytes();
  summary.geometry_seconds = watch.seconds();
  return geometry;
}

/// The emissive shapes as placed, in order, and which placed shape each is.
struct Emitters {
  std::vector<EmitterShape> shapes;
  std::vector<std::size_t> placed;
};

Emitters find_emitters(const Scene& scene, const Geometry& geometry, BuildSummary& summary) {
  Emitters emitters;
  std::size_t without_surface = 0;
  for (std::size_t i = 0; i < geometry.placed().size(); ++i) {
    const PlacedShape& placed = geometry.placed()[i];
    if (!placed.shape->emission) continue;
    if (std::holds_alternative<InterfaceMaterial>(scene.materials[placed.shape->material].kind)) {
      ++without_surface;
      continue;
    }
    const Instance* instance = placed.instance == kNone ? nullptr : &scene.instances[placed.instance];
    emitters.shapes.push_back({placed.shape, placed.to_world, instance});
    emitters.placed.push_back(i);
  }
  if (without_surface > 0) {
    summary.notes.push_back(std::to_string(without_surface) +
                            " area light(s) on shapes of interface material were left out; give them a material");
  }
  return emitters;
}

/// Lights by id: of the scene, of shapes, of media, of shapes that instances share.
LightGroups light_groups_of(const BuiltWorld& world, const std::vector<EmitterShape>& emitters) {
  LightGroupsBuilder builder(world.scene);
  if (!builder.needed()) return {};
  LightId id = 0;
  for (const Light& light : world.scene.lights) builder.add(id++, light.group);
  const LightId first_volume = world.lights.first_volume();
  const auto add_shapes = [&](bool shared) {
    for (std::size_t i = 0; i < emitters.size(); ++i) {
      const LightId first = world.lights.first_light(i);
      const bool is_shared = first >= first_volume && primitives_of(*emitters[i].shape) > 0;
      if (is_shared == shared) builder.add(first, emitters[i].shape->emission->group);
    }
  };
  add_shapes(false);
  for (id = first_volume; world.volume_lights.holds(id); ++id) {
    const auto medium = static_cast<std::size_t>(&world.volume_lights.medium(id) - world.media.data());
    builder.add(id, world.scene.media[medium].group);
  }
  add_shapes(true);
  return builder.finish(world.media, world.scene.media);
}

/// Boxes of everything a light can illuminate: shapes, and media beyond them.
Bounds3 scene_bounds(const Geometry& geometry, const std::vector<ParticipatingMedium>& media) {
  Bounds3 bounds = geometry.bounds();
  for (const ParticipatingMedium& medium : media) {
    if (!medium.homogeneous() && !medium.bounds().empty()) bounds.expand(medium.bounds());
  }
  return bounds;
}

/// The scene, whose boundaries and camera name media that it has. Throws Error (scene).
Scene with_media(Scene scene) {
  const auto is_there = [&](std::optional<MediumId> medium) { return !medium || *medium < scene.media.size(); };
  for (const Boundary& boundary : scene.boundaries) {
    if (!is_there(boundary.inside) || !is_there(boundary.outside))
      throw Error(Failure::scene, "a boundary's medium does not exist; add it to Scene::media");
  }
  if (!is_there(scene.camera.medium)) throw Error(Failure::scene, "the camera's medium does not exist; add it to Scene::media");
  return scene;
}

}  // namespace

/// It is known at the center; what lies between that and the origin is crossed first.
MediaState BuiltWorld::media_at_start(Vec3 origin) const {
  MediaState state = camera_media;
  if (camera.is_pinhole() || geometry.groups().empty()) return state;
  const Vec3 step = origin - camera.center();
  if (length_squared(step) == 0) return state;
  for (const Crossing& c : geometry.trace_all({camera.center(), step}, 0, 1)) state.cross(c.group, c.sign);
  return state;
}

BuiltWorld::BuiltWorld(Scene unit_scene, const BuildSettings& settings, const VolumeLimits& limits, BuildSummary& summary)
    : scene(with_media(std::move(unit_scene))),
      textures(build_textures(scene.textures, settings.kept)),
      materials(scene, textures),
      geometry(build_geometry(scene, textures, settings.threads, summary)),
      media(build_media(scene, settings, limits, summary)),
      camera(off_boundaries(scene.camera, scene.film, geometry), scene.film),
      filter(scene.filter),
      camera_media(find_camera_media(scene.camera.medium, camera.center(), geometry)),
      volume_lights(settings.volume_lights ? VolumeLights(media, geometry, camera_media.unbounded()) : VolumeLights()),
      has_volume_lights(settings.volume_lights) {
  media_emit = std::any_of(media.begin(), media.end(), [](const ParticipatingMedium& m) { return m.emissive(); });
  const Timer watch;
  const Emitters emitters = find_emitters(scene, geometry, summary);
  const std::vector<VolumeEmitter> volumes = volume_lights.emitters();
  lights = build_lights(scene, emitters.shapes, scene_bounds(geometry, media),
                        {.strategies = settings.lights,
                         .textures = &textures,
                         .threads = settings.threads,
                         .volumes = volumes,
                         .kept = settings.kept});
  volume_lights.set_first(lights.first_volume());
  light_distances = tyndall::light_distances(media, geometry.groups(), camera_media.unbounded(), lights, volume_lights);
  bright_media =
      BrightMedia(media, {geometry.groups(), camera_media.unbounded(), lights, volume_lights, scene_bounds(geometry, media)});
  if (!media.empty()) suns = Suns(lights);
  for (std::string& note : volume_lights.notes(scene.media)) summary.notes.push_back(std::move(note));
  light_groups = light_groups_of(*this, emitters.shapes);
  first_light.assign(geometry.placed().size(), kNone);
  for (std::size_t i = 0; i < emitters.placed.size(); ++i) first_light[emitters.placed[i]] = lights.first_light(i);
  has_panes = std::ranges::any_of(geometry.placed(), [this](const auto& p) { return materials.is_pane(p.shape->material); });
  summary.lights = lights.size();
  for (const SelectorStats& s : lights.selectors()) summary.light_strategies.push_back({s.strategy, s.seconds, s.memory_bytes});
  summary.light_bytes = lights.memory_bytes() + volume_lights.memory_bytes();
  summary.light_seconds = watch.seconds();
}

}  // namespace tyndall
