/// What Geometry is made of. Private to surface/geometry*.
#pragma once

#include <atomic>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>
#include <variant>

#include <embree3/rtcore.h>

#include "surface/convex_boundary.h"
#include "surface/geometry.h"
#include "surface/shape_mesh.h"
#include "surface/shape_quadric.h"

namespace tyndall {

struct EmbreeRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle>
using Embree = std::unique_ptr<std::remove_pointer_t<Handle>, EmbreeRelease>;

/// One shape in the space it was placed in. Its index in its set is its Embree geometry id.
struct Part {
  const Shape* shape;
  std::variant<PlacedMesh, PlacedQuadric> form;
  bool is_patch = false;  ///< the mesh is one of bilinear patches
  bool real = true;       ///< not of interface material
  std::uint32_t index = 0;
  Bounds3 box{};                             ///< of all primitives
  const Textures* alpha_textures = nullptr;  ///< null: opaque

  std::uint32_t primitive_count() const;
  Bounds3 primitive_bounds(std::uint32_t primitive) const;
  ShapeRoots intersect(std::uint32_t primitive, const ShapeRay& ray) const;
  ShapeSurface surface(std::uint32_t primitive, double u, double v) const;
  int orientation(std::uint32_t primitive) const;  ///< of ng against the roots' facing
  ShapeTangents tangents(std::uint32_t primitive, double u, double v) const;
  ShapeOutline outline(std::uint32_t primitive, const ShapeView& view) const;
  Enclosure enclosure(Vec3d center) const;  ///< by ng
};

/// The shapes of the world, or of one object. Two structures: real surfaces, and everything that bounds media.
struct PartSet {
  std::vector<Part> parts;
  Embree<RTCScene> real, boundary;  ///< null: nothing of that kind
  Bounds3 bounds;
};

/// An object placed in the world.
/// Rays beyond this are taken for misses: Embree's own limit is 1.844e18, and as the distribution builds it, it ends the
/// program at a ray beyond that or one that is not a number.
inline constexpr float kFarthest = 1e18f;
inline constexpr float kFarthestShape = 1e17f;  ///< so that rays between shapes stay within it

inline bool traceable(const RTCRay& r) {
  const auto within = [](float v) { return std::abs(v) <= kFarthest; };  // false for NaN
  return within(r.org_x) && within(r.org_y) && within(r.org_z) && within(r.dir_x) && within(r.dir_y) && within(r.dir_z) &&
         r.tnear <= r.tfar && r.tnear >= 0;
}

struct PlacedObject {
  const PartSet* set;
  AffineMap map;
  std::uint32_t first_placed;  ///< index into placed() of the object's first shape
};

/// The passage of a ray through one primitive of a boundary, before duplicates are removed.
struct BoundaryRecord {
  double t;
  double cosine;
  std::uint32_t group, shape, primitive;  ///< shape: into placed()
  int sign;
};
using BoundaryRecords = SmallVector<BoundaryRecord, 16>;

/// A boundary of the world that bounds media alone and is simple enough to be asked without a hierarchy (geometry_simple.cpp).
struct SimpleBoundary {
  const Part* part;  ///< the only one of its group
  std::uint32_t group;
  std::optional<ConvexBoundary> convex;  ///< nothing: the part is a quadric

  void record(const GeometryImpl& impl, const RTCRay& ray, BoundaryRecords& records) const;
};

struct GeometryImpl {
  GeometryImpl(const Scene& scene, const Textures* textures, int threads);

  // Embree reports to these until the device is gone, and everything built with the device is released before it.
  std::atomic<std::ptrdiff_t> embree_bytes = 0;
  std::mutex error_mutex;
  std::string error;  ///< first complaint of Embree
  Embree<RTCDevice> device;

  std::vector<PlacedShape> placed;
  std::vector<BoundaryGroup> groups;
  std::vector<std::unique_ptr<PartSet>> sets;  ///< the world, then one for each object
  std::vector<SimpleBoundary> simple;          ///< left out of the world's set of boundaries; few
  std::vector<PlacedObject> objects;           ///< one for each instance; Embree id: parts of the world + index
  Bounds3 bounds;
  std::size_t triangle_count = 0;

  const PartSet& world() const { return *sets.front(); }
  std::size_t vertex_bytes() const;

 private:
  void create_device(int threads);
  void bound_groups();
  void turn_groups();
  void find_simple_boundaries();
  void place_shapes(const Scene& scene);
  std::unique_ptr<PartSet> make_set(const Scene& scene, const std::vector<Shape>& shapes, const Textures* textures);
  void build_set(PartSet& set, bool with_objects);
  Embree<RTCScene> build_scene(PartSet& set, bool real, bool with_objects);
  void attach_part(RTCScene scene, Part& part, bool real);
  void attach_object(RTCScene scene, PlacedObject& object, std::uint32_t id, bool real);
  void check_embree();
};

/// One query; callbacks find it behind Embree's context, which must stay its first member.
struct GeometryQuery {
  enum class Boundaries { of_interfaces, all };

  RTCIntersectContext context;
  const GeometryImpl* impl = nullptr;
  Ray ray;                         ///< in the world: the seed of alpha's decisions
  std::uint32_t first_placed = 0;  ///< of the object being visited
  Boundaries boundaries = Boundaries::of_interfaces;
  BoundaryRecords* records = nullptr;
};

// Embree's callbacks, in geometry_callbacks.cpp.
void part_bounds(const RTCBoundsFunctionArguments* args);
void part_intersect(const RTCIntersectFunctionNArguments* args);
void part_occluded(const RTCOccludedFunctionNArguments* args);
void part_record(const RTCIntersectFunctionNArguments* args);
void part_alpha_filter(const RTCFilterFunctionNArguments* args);
void object_bounds(const RTCBoundsFunctionArguments* args);
void object_intersect(const RTCIntersectFunctionNArguments* args);
void object_occluded(const RTCOccludedFunctionNArguments* args);
void object_record(const RTCIntersectFunctionNArguments* args);

/// For a part's roots: those beyond the ray's ends may be left out.
ShapeRay ray_toward(const Part& part, const RTCRay& ray);

/// Of the part's primitive, as a boundary of `group`.
int boundary_sign(const GeometryImpl& impl, const Part& part, std::uint32_t primitive, std::uint32_t group, int facing);

/// Crossings from records: sorted, without duplicates (geometry_crossings.cpp).
Crossings crossings_of(BoundaryRecords& records, const Ray& ray);

SurfaceTangents surface_tangents(const GeometryImpl& impl, const SurfaceHit& hit);

/// The hit that Embree found, in the world (geometry_hit.cpp).
SurfaceHit surface_hit(const GeometryImpl& impl, const RTCRayHit& found);

}  // namespace tyndall
