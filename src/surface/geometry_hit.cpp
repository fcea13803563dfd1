#include "math/frame.h"
#include "surface/geometry_impl.h"

namespace tyndall {
namespace {

constexpr double kRounding = 0x1p-24;  // relative error of one rounding to float

/// A direction as floats that survive being squared, whatever its length was.
Vec3 safe_direction(Vec3d v, Vec3d ns) {
  const double l = length(v);
  if (!(l > 0) || !std::isfinite(l)) return Frame::around(to_vec3(ns)).x;
  return to_vec3(l > 1e-8 && l < 1e8 ? v : v * (1 / l));
}

}  // namespace

SurfaceHit surface_hit(const GeometryImpl& impl, const RTCRayHit& found) {
  const PlacedObject* object = found.hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? nullptr : &impl.objects[found.hit.instID[0]];
  const PartSet& set = object ? *object->set : impl.world();
  const Part& part = set.parts[found.hit.geomID];
  ShapeSurface s = part.surface(found.hit.primID, found.hit.u, found.hit.v);

  // A ray that starts here has its origin rounded in the world, and once more in the object's space.
  double error = s.error;
  if (object) {
    error += kRounding * dot(abs(s.ng), abs(s.p));
    const Vec3d ng = object->map.normal(s.ng);
    error /= std::max(length(ng), 1e-300);
    s.p = object->map.point(s.p);
    s.ng = normalize(ng);
    s.ns = normalize(object->map.normal(s.ns));
    if (dot(s.ng, s.ns) < 0) s.ns = -s.ns;
    s.dpdu = object->map.vector(s.dpdu);
  }
  error += 2 * kRounding * dot(abs(s.ng), abs(s.p));

  const std::uint32_t shape = (object ? object->first_placed : 0) + part.index;
  return {.t = found.ray.tfar,
          .p = to_vec3(s.p),
          .ng = to_vec3(s.ng),
          .ns = to_vec3(s.ns),
          .dpdu = safe_direction(s.dpdu, s.ns),
          .uv = s.uv,
          .shape = shape,
          .primitive = found.hit.primID,
          .group = impl.placed[shape].group,
          .barycentric = {found.hit.u, found.hit.v},
          .position_error = std::max(static_cast<float>(error), std::numeric_limits<float>::min())};
}

SurfaceTangents surface_tangents(const GeometryImpl& impl, const SurfaceHit& hit) {
  const std::uint32_t instance = impl.placed[hit.shape].instance;
  const PlacedObject* object = instance == kNone ? nullptr : &impl.objects[instance];
  const PartSet& set = object ? *object->set : impl.world();
  const Part& part = set.parts[hit.shape - (object ? object->first_placed : 0)];
  const ShapeTangents t = part.tangents(hit.primitive, hit.barycentric.x, hit.barycentric.y);
  const auto vector = [&](Vec3d v) { return to_vec3(object ? object->map.vector(v) : v); };
  const auto normal = [&](Vec3d n) { return to_vec3(object ? object->map.normal(n) : n); };
  return {vector(t.dpdu), vector(t.dpdv), vector(t.shading_dpdu), vector(t.shading_dpdv), normal(t.dndu), normal(t.dndv)};
}

}  // namespace tyndall
