#include "surface/geometry_impl.h"

namespace tyndall {

std::uint32_t Part::primitive_count() const {
  const auto* mesh = std::get_if<PlacedMesh>(&form);
  return mesh ? static_cast<std::uint32_t>(mesh->indices->size() / (is_patch ? 4 : 3)) : 1;
}

Bounds3 Part::primitive_bounds(std::uint32_t primitive) const {
  const auto* mesh = std::get_if<PlacedMesh>(&form);
  if (!mesh) return std::get<PlacedQuadric>(form).bounds();
  Bounds3 bounds;
  const std::uint32_t corners = is_patch ? 4 : 3;
  for (std::uint32_t i = 0; i < corners; ++i) bounds.expand(mesh->positions[(*mesh->indices)[corners * primitive + i]]);
  return bounds;
}

ShapeRoots Part::intersect(std::uint32_t primitive, const ShapeRay& ray) const {
  const auto* mesh = std::get_if<PlacedMesh>(&form);
  if (!mesh) return std::get<PlacedQuadric>(form).intersect(ray);
  if (is_patch) {
    const auto c = mesh->corners<4>(primitive);
    return intersect_patch(ray, {mesh->position(c[0]), mesh->position(c[1]), mesh->position(c[2]), mesh->position(c[3])});
  }
  const auto c = mesh->corners<3>(primitive);
  ShapeRoots roots;
  if (const auto root = intersect_triangle(ray, {mesh->position(c[0]), mesh->position(c[1]), mesh->position(c[2])})) {
    roots.push(*root);
  }
  return roots;
}

ShapeSurface Part::surface(std::uint32_t primitive, double u, double v) const {
  const auto* mesh = std::get_if<PlacedMesh>(&form);
  if (!mesh) return std::get<PlacedQuadric>(form).surface(u, v);
  return is_patch ? patch_surface(*mesh, primitive, u, v) : triangle_surface(*mesh, primitive, u, v);
}

int Part::orientation(std::uint32_t primitive) const {
  const auto* mesh = std::get_if<PlacedMesh>(&form);
  if (!mesh) return std::get<PlacedQuadric>(form).orientation();
  return is_patch ? patch_orientation(*mesh, primitive) : triangle_orientation(*mesh, primitive);
}

ShapeTangents Part::tangents(std::uint32_t primitive, double u, double v) const {
  const auto* mesh = std::get_if<PlacedMesh>(&form);
  if (!mesh) return std::get<PlacedQuadric>(form).tangents(u, v);
  return is_patch ? patch_tangents(*mesh, primitive, u, v) : triangle_tangents(*mesh, primitive, u, v);
}

/// A patch lies in the hull of its corners.
ShapeOutline Part::outline(std::uint32_t primitive, const ShapeView& view) const {
  const auto* mesh = std::get_if<PlacedMesh>(&form);
  if (!mesh) return std::get<PlacedQuadric>(form).outline(view);
  ShapeOutline points;
  const std::uint32_t corners = is_patch ? 4 : 3;
  for (std::uint32_t i = 0; i < corners; ++i) points.push_back(mesh->position((*mesh->indices)[corners * primitive + i]));
  return points;
}

Enclosure Part::enclosure(Vec3d center) const {
  const auto* mesh = std::get_if<PlacedMesh>(&form);
  if (!mesh) return std::get<PlacedQuadric>(form).enclosure(center);
  Enclosure e;
  for (std::uint32_t i = 0; i < primitive_count(); ++i) {
    const int side = orientation(i);
    const auto at = [&](std::uint32_t vertex) { return mesh->position(vertex) - center; };
    if (is_patch) {
      const auto c = mesh->corners<4>(i);
      e.add_triangle(at(c[0]), at(c[1]), at(c[3]), side);
      e.add_triangle(at(c[0]), at(c[3]), at(c[2]), side);
    } else {
      const auto c = mesh->corners<3>(i);
      e.add_triangle(at(c[0]), at(c[1]), at(c[2]), side);
    }
  }
  return e;
}

}  // namespace tyndall
