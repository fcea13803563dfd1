#include <cmath>
#include <optional>
#include <utility>

#include "session/memory_plan.h"
#include "session/scene_check.h"
#include "session/scene_hash.h"
#include "session/world_parts.h"
#include "tyndall/error.h"
#include "tyndall/frames.h"

namespace tyndall {
namespace {

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
  camera.lenses.reset();  // of no use to what images say of it
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
  check_values(scene);
  constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
  std::size_t volume_memory = kNoLimit;
  if (settings.max_memory != kNoLimit) {
    const MemoryPlan plan = plan_memory(scene, settings.lights, settings.kept);
    require_memory(plan, scene, settings.max_memory);
    volume_memory = left_for_volumes(plan, settings.max_memory);
  }
  // Of the scene as it was given, and now and not when an image is written: the files may be gone then. A file that
  // cannot be read is reported where it is used, with its place in the scene.
  std::uint64_t hash = 0;
  std::optional<Error> unread;
  try {
    hash = hash_scene(scene, settings.kept);
  } catch (const Error& e) {
    unread = e;
  }
  // All files of the scene were asked for by now: what others were made to is gone before more is made.
  if (settings.kept) settings.kept->drop_others();
  UnitScene unit_scene = in_unit_size(std::move(scene));
  require_camera_within_reach(unit_scene.scene.camera, unit_scene.scene.source);
  auto parts = std::make_unique<World::Parts>(std::move(unit_scene), settings, volume_memory);
  if (unread) throw Error(*unread);
  parts->scene_hash = hash;
  return World(std::move(parts));
}

World::Parts::Parts(UnitScene unit_scene, const BuildSettings& settings, std::size_t volume_memory)
    : to_user(unit_scene.to_user),
      unit(static_cast<float>(unit_scene.unit)),
      user_camera(as_given(unit_scene.scene.camera, to_user), unit_scene.scene.film),
      built(std::move(unit_scene.scene), settings, {volume_memory, unit_scene.unit}, summary) {}

}  // namespace tyndall
