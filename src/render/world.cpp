#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "math/timer.h"
#include "render/camera_media.h"
#include "render/memory_plan.h"
#include "render/scene_hash.h"
#include "render/world_parts.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

std::vector<ParticipatingMedium> build_media(const Scene& scene, const BuildSettings& settings, std::size_t most_memory,
                                             BuildSummary& summary) {
  const Timer watch;
  std::vector<ParticipatingMedium> media;
  media.reserve(scene.media.size());
  for (const Medium& medium : scene.media) {
    const std::size_t left = most_memory - std::min(summary.volume_bytes, most_memory);
    media.push_back(build_medium(medium, {.sanitize = settings.sanitize, .most_memory = left}, summary.notes));
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

/// Boxes of everything a light can shine on: shapes, and media beyond them.
Bounds3 scene_bounds(const Geometry& geometry, const std::vector<ParticipatingMedium>& media) {
  Bounds3 bounds = geometry.bounds();
  for (const ParticipatingMedium& medium : media) {
    if (!medium.homogeneous() && !medium.bounds().empty()) bounds.expand(medium.bounds());
  }
  return bounds;
}

/// Rays from farther away lose all detail, and the ray tracing library refuses them.
void require_camera_within_reach(const Camera& camera, const std::string& source) {
  constexpr float kFarthest = 1e17f;
  const Vec3 eye = camera.to_world.point({0, 0, 0});
  for (int i = 0; i < 3; ++i) {
    if (std::abs(eye[i]) <= kFarthest) continue;
    throw Error(Failure::scene,
                (source.empty() ? "the scene" : source) +
                    ": the camera is more than 1e17 times the size of the scene away from it; correct its transform");
  }
}

Camera as_given(Camera camera, const Transform& to_user) {
  camera.to_world = to_user * camera.to_world;
  return camera;
}

}  // namespace

World::World(std::unique_ptr<const Parts> parts) : parts_(std::move(parts)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

const BuildSummary& World::summary() const { return parts_->summary; }

std::string World::scene_hash(const RenderSettings& settings) const { return scene_hash_text(parts_->scene_hash, settings); }

World build(Scene scene, const BuildSettings& settings) {
  constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
  std::size_t volume_memory = kNoLimit;
  if (settings.max_memory != kNoLimit) {
    const MemoryPlan plan = plan_memory(scene, settings.lights);
    require_memory(plan, scene, settings.max_memory);
    volume_memory = left_for_volumes(plan, settings.max_memory);
  }
  // Of the scene as it was given, and now and not when an image is written: the files may be gone then. A file that
  // cannot be read is reported by who uses it, with its place in the scene.
  std::uint64_t hash = 0;
  std::optional<Error> unread;
  try {
    hash = hash_scene(scene);
  } catch (const Error& e) {
    unread = e;
  }
  UnitScene unit_scene = in_unit_size(std::move(scene));
  require_camera_within_reach(unit_scene.scene.camera, unit_scene.scene.source);
  auto parts = std::make_unique<World::Parts>(std::move(unit_scene), settings, volume_memory);
  if (unread) throw Error(*unread);
  parts->scene_hash = hash;
  return World(std::move(parts));
}

World::Parts::Parts(UnitScene unit_scene, const BuildSettings& settings, std::size_t volume_memory)
    : scene(std::move(unit_scene.scene)),
      to_user(unit_scene.to_user),
      unit(static_cast<float>(unit_scene.unit)),
      user_camera(as_given(scene.camera, to_user), scene.film),
      textures(build_textures(scene.textures)),
      materials(scene, textures),
      geometry(build_geometry(scene, textures, settings.threads, summary)),
      media(build_media(scene, settings, volume_memory, summary)),
      fire(settings.fire ? FireLights(media, geometry.groups(), scene.camera.medium) : FireLights()),
      has_fire(settings.fire),
      camera(scene.camera, scene.film),
      filter(scene.filter) {
  const Timer watch;
  const Emitters emitters = find_emitters(scene, geometry, summary);
  const std::vector<VolumeEmitter> volumes = fire.emitters();
  lights =
      build_lights(scene, emitters.shapes, scene_bounds(geometry, media),
                   {.strategies = settings.lights, .textures = &textures, .threads = settings.threads, .volumes = volumes});
  fire.set_first(lights.first_volume());
  near_lamps = tyndall::near_lamps(media, geometry.groups(), scene.camera.medium, lights, fire);
  glow = MediaGlow(media, {geometry.groups(), scene.camera.medium, lights, fire, scene_bounds(geometry, media)});
  for (std::string& note : fire.notes(scene.media)) summary.notes.push_back(std::move(note));
  first_light.assign(geometry.placed().size(), kNone);
  for (std::size_t i = 0; i < emitters.placed.size(); ++i) first_light[emitters.placed[i]] = lights.first_light(i);
  summary.lights = lights.size();
  for (const SelectorStats& s : lights.selectors()) summary.light_strategies.push_back({s.strategy, s.seconds, s.memory_bytes});
  summary.light_bytes = lights.memory_bytes() + fire.memory_bytes();
  summary.light_seconds = watch.seconds();
  camera_media = find_camera_media(scene.camera.medium, camera.center(), geometry);
}

}  // namespace tyndall
