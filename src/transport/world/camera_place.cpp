#include "transport/world/camera_place.h"

#include <algorithm>

#include "math/vec3d.h"
#include "transport/camera/camera_ray.h"
#include "transport/media/camera_media.h"

namespace tyndall {
namespace {

/// Of the coordinates: nearer than 8 roundings a point is on a boundary; 32 away, by half of that at a slope of 30 degrees,
/// none of its rays is.
constexpr float kOn = 0x1p-20f, kMoved = 0x1p-18f;
/// Of the smallest thing that has a boundary, for what stands at the origin.
constexpr float kOfSize = 0x1p-10f;
/// Places along each side of the film from where rays begin.
constexpr int kAcross = 5;

float size_at(Vec3 p, const Geometry& geometry) {
  float smallest = kInfinity;
  for (const BoundaryGroup& group : geometry.groups()) smallest = std::min(smallest, length(group.bounds.extent()));
  return std::max(static_cast<float>(largest_coordinate(Vec3d(p))), kOfSize * smallest);
}

bool is_on_boundary(Vec3 p, const Geometry& geometry) {
  const float near = kOn * size_at(p, geometry);
  const auto directions = directions_all_around();
  return std::any_of(directions.begin(), directions.end(), [&](Vec3 d) {
    return !geometry.trace_all({p - near * d, d}, 0, 2 * near).empty();
  });
}

/// The camera's center, and where its rays begin if that is elsewhere.
bool is_on_boundary(const CameraRays& rays, const Film& film, const Geometry& geometry) {
  if (is_on_boundary(rays.center(), geometry)) return true;
  if (rays.is_pinhole() || rays.is_spherical()) return false;
  for (int i = 0; i < kAcross * kAcross; ++i) {
    const Vec2 at{(0.5f + i % kAcross) / kAcross, (0.5f + i / kAcross) / kAcross};
    const auto sample = rays.sample({at.x * film.width, at.y * film.height}, {0.5f, 0.5f});
    if (sample && is_on_boundary(sample->ray.o, geometry)) return true;
  }
  return false;
}

Camera moved(Camera camera, Vec3 by) {
  camera.to_world = Transform::translate(by.x, by.y, by.z) * camera.to_world;
  return camera;
}

/// Whether the medium that the camera declares is within something there.
bool finds_its_medium(const Camera& camera, const Geometry& geometry) {
  const Vec3 center = camera.to_world.point({0, 0, 0});
  return find_camera_media({}, center, geometry).brings(*camera.medium, geometry.groups());
}

}  // namespace

Camera off_boundaries(Camera camera, const Film& film, const Geometry& geometry) {
  if (geometry.groups().empty()) return camera;
  const CameraRays rays(camera, film);
  if (!is_on_boundary(rays, film, geometry)) return camera;
  // Not along the view alone, which may lie in the boundary.
  const Vec3 ahead = kMoved * size_at(rays.center(), geometry) * normalize(camera.to_world.vector({0.5f, 0.3f, 1}));
  const Camera before = moved(camera, ahead);
  if (!camera.medium || finds_its_medium(before, geometry)) return before;
  const Camera behind = moved(camera, -ahead);
  return finds_its_medium(behind, geometry) ? behind : before;
}

}  // namespace tyndall
