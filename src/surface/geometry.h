/// Ray tracing over a scene's shapes: the nearest real surface, and the media boundaries before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "math/small_vector.h"
#include "surface/shape_root.h"
#include "tyndall/scene.h"

namespace tyndall {

class Textures;
struct GeometryImpl;

inline constexpr std::uint32_t kNone = 0xffffffff;

/// One shape as placed in the world: a scene shape, or one shape of one instance of an object.
/// The order of placed() is Scene::shapes, then for each instance the shapes of its object.
struct PlacedShape {
  const Shape* shape;
  Transform to_world;      ///< from the shape's own space, the instance's transform included
  std::uint32_t instance;  ///< index into Scene::instances, or kNone
  std::uint32_t group;     ///< index into groups(), or kNone
};

/// A boundary group in the world: one Scene::boundaries entry outside instances, or within one instance.
struct BoundaryGroup {
  std::optional<MediumId> inside, outside;
  Bounds3 bounds{};  ///< of its shapes, world space
  /// Closed, with normals that point inward (ReverseOrientation, a mirrored quadric): what it holds was the scene's outside
  /// medium, exchanged here. Where there was none, the inside medium stays within, since it cannot fill all space.
  bool inverted = false;
};

struct SurfaceHit {
  float t;
  Vec3 p;
  Vec3 ng;    ///< unit geometric normal in pbrt's orientation: on a boundary it points outside
  Vec3 ns;    ///< unit shading normal; dot(ns, ng) >= 0
  Vec3 dpdu;  ///< not normalised; of the shading geometry, perpendicular to ns
  Vec2 uv;
  std::uint32_t shape;      ///< index into placed()
  std::uint32_t primitive;  ///< triangle or patch of a mesh, 0 for other shapes
  std::uint32_t group;      ///< boundary group of the surface, kNone when it bounds no media
  Vec2 barycentric;         ///< weights of vertices 1 and 2 of a triangle; (u, v) of a patch or quadric before its uvs
  float position_error;     ///< how far p can be from the surface that rays are tested against
};

/// How the surface goes on about a hit, in world space (pbrt's partial derivatives); for bump mapping and footprints.
struct SurfaceTangents {
  Vec3 dpdu, dpdv;                  ///< of the surface itself
  Vec3 shading_dpdu, shading_dpdv;  ///< of the shading geometry
  Vec3 dndu, dndv;                  ///< of the shading normal
};

/// A passage of the ray through the boundary of a group.
struct Crossing {
  float t;
  std::uint32_t group;  ///< index into groups()
  int sign;             ///< +1 enters the group, -1 leaves it
};
using Crossings = SmallVector<Crossing, 8>;

/// What a ray met. Crossings are sorted by t. Per group they are exact: a line through closed shapes with shared vertices
/// leaves as often as it enters, through edges and corners too. Shapes of a group that say the same at one t (copies, or
/// neighbours at an edge) count once; what enters and leaves at one t, to rounding, cancels.
struct Trace {
  std::optional<SurfaceHit> hit;  ///< nearest surface that is not of interface material
  /// Where the segment through media ends: at the hit, or t_max. A boundary that is nearer to the hit than offset_origin() on
  /// its near side (coplanar with the surface, say) belongs to the far side: the segment then ends there, since what happened
  /// past it would be on the wrong side of it.
  float t_end;
  Crossings crossings;  ///< of interface boundaries in (t_min, t_end)
};

/// Immutable after construction; every query may be made from any number of threads.
/// Ray directions need not be unit; t counts in their length. The Scene must outlive it.
class Geometry {
 public:
  /// Builds the acceleration structures with `threads` threads (<= 0: one a core). `textures` is read for alpha and
  /// may be null: alpha is then 1. Throws Error (scene) at a shape with broken data, Error (run_time) when memory runs out.
  Geometry(const Scene& scene, const Textures* textures, int threads);
  ~Geometry();
  Geometry(Geometry&&) noexcept;
  Geometry& operator=(Geometry&&) noexcept;

  /// Nearest real surface in (t_min, t_max) and the interface boundaries before it.
  /// Alpha is decided by a hash of the ray, so the same ray always meets the same surface.
  Trace trace(const Ray& ray, float t_min, float t_max) const;

  /// The interface boundaries in (t_min, t_max); nothing when a real surface blocks the ray.
  std::optional<Crossings> trace_shadow(const Ray& ray, float t_min, float t_max) const;

  /// Whether a real surface blocks the ray in (t_min, t_max): without what trace_shadow() tells beyond that.
  bool occluded(const Ray& ray, float t_min, float t_max) const;

  /// Every boundary in (t_min, t_max), also those of real surfaces; nothing blocks. To find what holds a point: over a
  /// ray from it to infinity, in any direction, minus the sum of a group's signs is how often the group holds the point.
  Crossings trace_all(const Ray& ray, float t_min, float t_max) const;

  /// Worked out when asked for: few surfaces need it.
  SurfaceTangents tangents(const SurfaceHit& hit) const;

  /// Of a primitive of a placed shape; empty where it is not known.
  ShapeOutline outline(std::uint32_t shape, std::uint32_t primitive, const ShapeView& view) const;

  /// Origin for a ray that leaves the hit along `direction` and does not meet the same surface again at t > 0.
  Vec3 offset_origin(const SurfaceHit& hit, Vec3 direction) const;

  const std::vector<PlacedShape>& placed() const;
  const std::vector<BoundaryGroup>& groups() const;
  Bounds3 bounds() const;              ///< of all shapes, interfaces included; empty without shapes
  std::size_t triangle_count() const;  ///< stored, so those of an object count once
  std::size_t memory_bytes() const;    ///< vertices and acceleration structures

 private:
  std::unique_ptr<GeometryImpl> impl_;
};

}  // namespace tyndall
