#include <bit>

#include "math/hash.h"
#include "surface/geometry_impl.h"
#include "texture/textures.h"

namespace tyndall {
namespace {

// Rays are traced one at a time, so every packet is a single ray [Embree 3: N is then 1].
GeometryQuery& query_of(RTCIntersectContext* context) { return *reinterpret_cast<GeometryQuery*>(context); }

ShapeRay shape_ray(const RTCRay& ray) {
  return {Vec3d(ray.org_x, ray.org_y, ray.org_z), Vec3d(ray.dir_x, ray.dir_y, ray.dir_z)};
}

/// A number in [0, 1) that depends on the ray and the place it meets, and on nothing else.
float alpha_threshold(const Ray& ray, std::uint32_t shape, std::uint32_t primitive, int which) {
  const auto pair = [](float a, float b) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
  };
  const std::uint64_t h = hash(pair(ray.o.x, ray.o.y), pair(ray.o.z, ray.d.x), pair(ray.d.y, ray.d.z),
                               std::uint64_t{shape} << 32 | primitive, static_cast<std::uint64_t>(which));
  return unit_float(h);
}

/// Whether the surface stops the ray: its alpha against the ray's own number, as pbrt.
bool stops(const Part& part, const GeometryQuery& query, std::uint32_t primitive, const ShapeRoot& root, int which) {
  if (!part.alpha_textures) return true;
  const std::uint32_t shape = query.first_placed + part.index;
  const ShapeSurface surface = part.surface(primitive, root.u, root.v);
  Vec3d p = surface.p, n = surface.ng;
  const std::uint32_t instance = query.impl->placed[shape].instance;
  if (instance != kNone) {
    const auto& map = query.impl->objects[instance].map;
    p = map.point(p), n = normalize(map.normal(n));
  }
  const float alpha = part.alpha_textures->eval_float(*part.shape->alpha, {surface.uv, to_vec3(p), to_vec3(n)});
  if (alpha >= 1) return true;
  return alpha > 0 && alpha_threshold(query.ray, shape, primitive, which) <= alpha;
}

std::optional<ShapeRoot> nearest_stop(const Part& part, const GeometryQuery& query, std::uint32_t primitive,
                                      const RTCRay& ray) {
  std::optional<ShapeRoot> best;
  int which = 0;
  for (const ShapeRoot& root : part.intersect(primitive, ray_toward(part, ray))) {
    const int number = which++;
    const auto t = static_cast<float>(root.t);
    if (!(t > ray.tnear && t < ray.tfar) || (best && best->t <= root.t)) continue;
    if (stops(part, query, primitive, root, number)) best = root;
  }
  return best;
}

void write_hit(RTCRayHit& rayhit, const ShapeRoot& root, const RTCIntersectFunctionNArguments& args) {
  rayhit.ray.tfar = static_cast<float>(root.t);
  rayhit.hit.u = static_cast<float>(root.u);
  rayhit.hit.v = static_cast<float>(root.v);
  rayhit.hit.primID = args.primID;
  rayhit.hit.geomID = args.geomID;
  rayhit.hit.instID[0] = args.context->instID[0];
}

RTCRay ray_in(const PlacedObject& object, const RTCRay& ray) {
  const ShapeRay outer = shape_ray(ray);
  const Vec3 o = to_vec3(object.map.inverse_point(outer.o)), d = to_vec3(object.map.inverse_vector(outer.d));
  RTCRay inner = ray;
  inner.org_x = o.x, inner.org_y = o.y, inner.org_z = o.z;
  inner.dir_x = d.x, inner.dir_y = d.y, inner.dir_z = d.z;
  return inner;
}

/// Makes the query stand inside an object while it lives.
class Visit {
 public:
  Visit(RTCIntersectContext* context, const PlacedObject& object) : context_(context) {
    GeometryQuery& query = query_of(context);
    context->instID[0] = static_cast<unsigned>(&object - query.impl->objects.data());
    query.first_placed = object.first_placed;
  }
  ~Visit() {
    context_->instID[0] = RTC_INVALID_GEOMETRY_ID;
    query_of(context_).first_placed = 0;
  }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

 private:
  RTCIntersectContext* context_;
};

/// Widened by a few roundings: a flat box would make traversal depend on the last bit.
void write_bounds(const Bounds3& b, RTCBounds& out) {
  const Vec3 size = max(max(b.max, -b.max), max(b.min, -b.min));
  const Vec3 margin = size * 0x1p-21f + Vec3{1e-30f, 1e-30f, 1e-30f};
  const Vec3 low = b.min - margin, high = b.max + margin;
  out.lower_x = low.x, out.lower_y = low.y, out.lower_z = low.z;
  out.upper_x = high.x, out.upper_y = high.y, out.upper_z = high.z;
}

}  // namespace

/// Alpha counts roots, wherever the ray ends.
ShapeRay ray_toward(const Part& part, const RTCRay& ray) {
  ShapeRay r = shape_ray(ray);
  if (!part.alpha_textures) r.t_min = ray.tnear, r.t_max = ray.tfar;
  return r;
}

void part_bounds(const RTCBoundsFunctionArguments* args) {
  write_bounds(static_cast<const Part*>(args->geometryUserPtr)->primitive_bounds(args->primID), *args->bounds_o);
}

void part_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& part = *static_cast<const Part*>(args->geometryUserPtr);
  auto& rayhit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  if (const auto root = nearest_stop(part, query_of(args->context), args->primID, rayhit.ray)) write_hit(rayhit, *root, *args);
}

void part_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& part = *static_cast<const Part*>(args->geometryUserPtr);
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  if (nearest_stop(part, query_of(args->context), args->primID, ray)) ray.tfar = -std::numeric_limits<float>::infinity();
}

// A real surface counts among the boundaries of a path only where alpha lets the ray through it.
void part_record(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& part = *static_cast<const Part*>(args->geometryUserPtr);
  const GeometryQuery& query = query_of(args->context);
  const bool only_if_passed = part.real && query.boundaries == GeometryQuery::Boundaries::of_interfaces;
  if (only_if_passed && !part.alpha_textures) return;

  const RTCRay& ray = reinterpret_cast<const RTCRayHit*>(args->rayhit)->ray;
  const std::uint32_t shape = query.first_placed + part.index;
  int which = 0;
  for (const ShapeRoot& root : part.intersect(args->primID, ray_toward(part, ray))) {
    const int number = which++;
    if (!(root.t > ray.tnear && root.t < ray.tfar)) continue;
    if (only_if_passed && stops(part, query, args->primID, root, number)) continue;
    const std::uint32_t group = query.impl->placed[shape].group;
    const int sign = boundary_sign(*query.impl, part, args->primID, group, root.facing);
    query.records->push_back({root.t, root.cosine, group, shape, args->primID, sign});
  }
}

int boundary_sign(const GeometryImpl& impl, const Part& part, std::uint32_t primitive, std::uint32_t group, int facing) {
  return -facing * part.orientation(primitive) * (impl.groups[group].inverted ? -1 : 1);
}

void part_alpha_filter(const RTCFilterFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& part = *static_cast<const Part*>(args->geometryUserPtr);
  const ShapeRoot root{0, 0, 0, RTCHitN_u(args->hit, 1, 0), RTCHitN_v(args->hit, 1, 0)};
  if (!stops(part, query_of(args->context), RTCHitN_primID(args->hit, 1, 0), root, 0)) args->valid[0] = 0;
}

void object_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& object = *static_cast<const PlacedObject*>(args->geometryUserPtr);
  Bounds3 world;
  for (int i = 0; i < 8; ++i) world.expand(to_vec3(object.map.point(Vec3d(object.set->bounds.corner(i)))));
  write_bounds(world, *args->bounds_o);
}

// Objects are entered here rather than by Embree's own instances, whose single-precision inverse would move a ray by
// several units in the last place of the instance's offset; here it is rounded once, in the object's own space.
void object_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& object = *static_cast<const PlacedObject*>(args->geometryUserPtr);
  auto& rayhit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const Visit visit(args->context, object);
  RTCRayHit inner{ray_in(object, rayhit.ray), {}};
  inner.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  if (!traceable(inner.ray)) return;
  rtcIntersect1(object.set->real.get(), args->context, &inner);
  if (inner.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
  rayhit.hit = inner.hit;
  rayhit.hit.instID[0] = args->context->instID[0];
  rayhit.ray.tfar = inner.ray.tfar;
}

void object_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& object = *static_cast<const PlacedObject*>(args->geometryUserPtr);
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  const Visit visit(args->context, object);
  RTCRay inner = ray_in(object, ray);
  if (!traceable(inner)) return;
  rtcOccluded1(object.set->real.get(), args->context, &inner);
  if (inner.tfar < 0) ray.tfar = inner.tfar;
}

void object_record(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& object = *static_cast<const PlacedObject*>(args->geometryUserPtr);
  const Visit visit(args->context, object);
  RTCRayHit inner{ray_in(object, reinterpret_cast<const RTCRayHit*>(args->rayhit)->ray), {}};
  inner.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  if (!traceable(inner.ray)) return;
  rtcIntersect1(object.set->boundary.get(), args->context, &inner);
}

}  // namespace tyndall
