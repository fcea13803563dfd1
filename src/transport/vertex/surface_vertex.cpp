#include "transport/vertex/surface_vertex.h"

#include <bit>

#include "math/hash.h"

namespace tyndall {
namespace {

/// A uniform number that depends on where a surface is seen and from where, and on nothing else: makes the choices of
/// mix materials and of coated materials' walks repeatable, as in pbrt.
float hash_to_unit(Vec3 p, Vec3 w) {
  const auto bits = [](float f) { return static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(f)); };
  const std::uint64_t h = hash(bits(p.x), bits(p.y), bits(p.z), bits(w.x), bits(w.y), bits(w.z));
  return unit_float(h);
}

/// Every hit takes the camera's footprint, reduced as pbrt reduces it for 64 samples a pixel and more: a picture must not
/// depend on how many are yet to come.
SurfaceDetail surface_detail(const BuiltWorld& world, const SurfaceHit& hit) {
  constexpr float kShare = 0.125f;
  const auto [dpdx, dpdy] = world.camera.pixel_steps(hit.p, hit.ng);
  const SurfaceTangents tangents = world.geometry.tangents(hit);
  return {tangents, footprint_on(tangents, kShare * dpdx, kShare * dpdy)};
}

}  // namespace

Vertex surface_vertex(const BuiltWorld& world, const SurfaceHit& hit, Vec3 wo, const MediaState& media,
                      std::optional<int> channel) {
  const Materials& materials = world.materials;
  const MaterialId material = world.material_of(hit);
  SurfaceQuery query{.p = hit.p,
                     .uv = hit.uv,
                     .shading = Frame::around(hit.ns, hit.dpdu),
                     .wo = wo,
                     .random = hash_to_unit(hit.p, wo),
                     .ng = hit.ng};
  std::optional<SurfaceDetail> detail;
  if (materials.wants_detail(material)) query.detail = &detail.emplace(surface_detail(world, hit));
  if (materials.is_dispersive(material)) query.channel = *channel;
  Vertex::Surface surface{hit, materials.bsdf(material, query)};
  if (materials.bends_normals(material)) surface.hit.ns = surface.bsdf.normal();  // what lights are chosen by
  return Vertex(surface, wo, media);
}

std::optional<BehindPane> behind_pane(const BuiltWorld& world, const Ray& ray, const SurfaceHit& hit, const MediaState& media) {
  if (!world.materials.is_pane(world.material_of(hit))) return std::nullopt;
  const Vertex pane = surface_vertex(world, hit, -ray.d, media, std::nullopt);
  const float unbent = pane.unbent();
  if (unbent == 0) return std::nullopt;
  return BehindPane{{pane.origin(world.geometry, ray.d), ray.d}, pane.media_toward(world.geometry, ray.d), unbent};
}

}  // namespace tyndall
