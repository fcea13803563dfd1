/// Triangle and bilinear meshes with their vertices placed, as pbrt bakes them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/shape_root.h"
#include "tyndall/scene.h"

namespace tyndall {

/// A mesh in the space it was placed in: the world, or an object's definition space.
struct PlacedMesh {
  std::vector<Vec3> positions;  ///< with padding behind the last one, so that 16-byte loads of any vertex are safe
  std::vector<Vec3> normals;    ///< oriented; empty: none
  const std::vector<Vec2>* uvs;
  const std::vector<std::uint32_t>* indices;
  bool flip = false;  ///< reverse_orientation XOR swapped handedness: ng is against the winding

  template <std::size_t N>
  std::array<std::uint32_t, N> corners(std::uint32_t primitive) const {
    std::array<std::uint32_t, N> c;
    for (std::size_t i = 0; i < N; ++i) c[i] = (*indices)[N * primitive + i];
    return c;
  }
  Vec3d position(std::uint32_t vertex) const { return Vec3d(positions[vertex]); }
};

/// Throws Error at the shape's place: an index out of range, counts that disagree, a vertex that is not finite.
PlacedMesh place_mesh(const TriangleMesh& mesh, const Shape& shape);
PlacedMesh place_mesh(const BilinearMesh& mesh, const Shape& shape);

/// Where the ray meets triangle abc, decided exactly: of the triangles of a closed mesh those that a line meets
/// always sum to zero in `facing`, also through edges and vertices. Edge-on triangles are never met.
std::optional<ShapeRoot> intersect_triangle(const ShapeRay& ray, const std::array<Vec3d, 3>& abc);

/// Where the ray meets the patch p00 p10 p01 p11. The sum of `facing` is exactly the winding of its outline around the
/// ray, so patches and triangles that share edges leave no gap.
ShapeRoots intersect_patch(const ShapeRay& ray, const std::array<Vec3d, 4>& p);

ShapeSurface triangle_surface(const PlacedMesh& mesh, std::uint32_t primitive, double b1, double b2);
ShapeSurface patch_surface(const PlacedMesh& mesh, std::uint32_t primitive, double u, double v);
ShapeTangents triangle_tangents(const PlacedMesh& mesh, std::uint32_t primitive, double b1, double b2);
ShapeTangents patch_tangents(const PlacedMesh& mesh, std::uint32_t primitive, double u, double v);

/// +1 or -1: whether ng of the primitive is along its winding, by pbrt's rules: vertex normals decide where there are any.
int triangle_orientation(const PlacedMesh& mesh, std::uint32_t primitive);
int patch_orientation(const PlacedMesh& mesh, std::uint32_t primitive);

}  // namespace tyndall
