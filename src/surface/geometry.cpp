#include "surface/geometry.h"

#include "surface/geometry_impl.h"

namespace tyndall {
namespace {

RTCRayHit embree_ray(const Ray& ray, float t_min, float t_max) {
  RTCRayHit r{};
  r.ray = {.org_x = ray.o.x,
           .org_y = ray.o.y,
           .org_z = ray.o.z,
           .tnear = t_min,
           .dir_x = ray.d.x,
           .dir_y = ray.d.y,
           .dir_z = ray.d.z,
           .time = 0,
           .tfar = t_max,
           .mask = ~0u,
           .id = 0,
           .flags = 0};
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return r;
}

GeometryQuery make_query(const GeometryImpl& impl, const Ray& ray) {
  GeometryQuery query;
  rtcInitIntersectContext(&query.context);
  query.impl = &impl;
  query.ray = ray;
  return query;
}

Crossings find_crossings(const GeometryImpl& impl, RTCRayHit ray, GeometryQuery::Boundaries which, const Ray& world_ray) {
  RTCScene scene = impl.world().boundary.get();
  if (!scene && impl.simple.empty()) return {};
  if (!(ray.ray.tnear < ray.ray.tfar) || !traceable(ray.ray)) return {};
  BoundaryRecords records;
  for (const SimpleBoundary& boundary : impl.simple) boundary.record(impl, ray.ray, records);
  if (scene) {
    GeometryQuery query = make_query(impl, world_ray);
    query.boundaries = which;
    query.records = &records;
    rtcIntersect1(scene, &query.context, &ray);
  }
  return records.empty() ? Crossings{} : crossings_of(records, world_ray);
}

/// The t at which the ray is as near to the hit as the origin of a ray that leaves it on the same side.
float last_t_before(const SurfaceHit& hit, const Ray& ray) {
  const float slope = std::max(abs_dot(hit.ng, ray.d), 1e-3f * length(ray.d));
  return hit.t - hit.position_error / slope;
}

/// Drops the crossings beyond `last`. Nothing may happen past the first of them.
void leave_to_far_side(Trace& trace, float last) {
  std::size_t near = 0;
  while (near < trace.crossings.size() && trace.crossings[near].t < last) ++near;
  if (near == trace.crossings.size()) return;
  trace.t_end = trace.crossings[near].t;
  trace.crossings.truncate(near);
}

}  // namespace

Geometry::Geometry(const Scene& scene, const Textures* textures, int threads)
    : impl_(std::make_unique<GeometryImpl>(scene, textures, threads)) {}
Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;

Trace Geometry::trace(const Ray& ray, float t_min, float t_max) const {
  Trace trace{.hit = {}, .t_end = t_max, .crossings = {}};
  RTCRayHit r = embree_ray(ray, t_min, t_max);
  if (RTCScene scene = impl_->world().real.get(); scene && traceable(r.ray)) {
    GeometryQuery query = make_query(*impl_, ray);
    rtcIntersect1(scene, &query.context, &r);
    if (r.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
      trace.hit = surface_hit(*impl_, r);
      trace.t_end = trace.hit->t;
    }
  }
  r.ray.tfar = trace.t_end;
  trace.crossings = find_crossings(*impl_, r, GeometryQuery::Boundaries::of_interfaces, ray);
  if (trace.hit) leave_to_far_side(trace, last_t_before(*trace.hit, ray));
  return trace;
}

bool Geometry::occluded(const Ray& ray, float t_min, float t_max) const {
  RTCScene scene = impl_->world().real.get();
  if (!scene) return false;
  RTCRay shadow = embree_ray(ray, t_min, t_max).ray;
  if (!traceable(shadow)) return false;
  GeometryQuery query = make_query(*impl_, ray);
  rtcOccluded1(scene, &query.context, &shadow);
  return shadow.tfar < 0;
}

std::optional<Crossings> Geometry::trace_shadow(const Ray& ray, float t_min, float t_max) const {
  if (occluded(ray, t_min, t_max)) return {};
  return find_crossings(*impl_, embree_ray(ray, t_min, t_max), GeometryQuery::Boundaries::of_interfaces, ray);
}

Crossings Geometry::trace_all(const Ray& ray, float t_min, float t_max) const {
  return find_crossings(*impl_, embree_ray(ray, t_min, t_max), GeometryQuery::Boundaries::all, ray);
}

SurfaceTangents Geometry::tangents(const SurfaceHit& hit) const { return surface_tangents(*impl_, hit); }

ShapeOutline Geometry::outline(std::uint32_t shape, std::uint32_t primitive, const ShapeView& view) const {
  const std::uint32_t instance = impl_->placed[shape].instance;
  if (instance == kNone) return impl_->world().parts[shape].outline(primitive, view);
  const PlacedObject& object = impl_->objects[instance];
  const ShapeView inner{view.along ? object.map.inverse_vector(view.from) : object.map.inverse_point(view.from), view.along};
  ShapeOutline points = object.set->parts[shape - object.first_placed].outline(primitive, inner);
  for (Vec3d& p : points) p = object.map.point(p);
  return points;
}

Vec3 Geometry::offset_origin(const SurfaceHit& hit, Vec3 direction) const {
  const float side = dot(hit.ng, direction) < 0 ? -1.0f : 1.0f;
  const Vec3 offset = hit.ng * (side * hit.position_error);
  Vec3 origin = hit.p + offset;
  for (int i = 0; i < 3; ++i) {  // the sum is rounded away from the surface, never toward it
    if (offset[i] != 0) origin[i] = std::nextafter(origin[i], offset[i] > 0 ? kInfinity : -kInfinity);
  }
  return origin;
}

const std::vector<PlacedShape>& Geometry::placed() const { return impl_->placed; }
const std::vector<BoundaryGroup>& Geometry::groups() const { return impl_->groups; }
Bounds3 Geometry::bounds() const { return impl_->bounds; }
std::size_t Geometry::triangle_count() const { return impl_->triangle_count; }
std::size_t Geometry::memory_bytes() const {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(impl_->embree_bytes, 0)) + impl_->vertex_bytes();
}

}  // namespace tyndall
