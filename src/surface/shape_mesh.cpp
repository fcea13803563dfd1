#include "surface/shape_mesh.h"

#include <string>

namespace tyndall {
namespace {

constexpr std::size_t kPadding = 2;  // vertices behind the last one

void check_counts(std::size_t positions, std::size_t normals, std::size_t uvs, const Shape& shape) {
  if (normals != 0 && normals != positions) {
    throw Error(shape.where, "the mesh has " + std::to_string(positions) + " vertices but " + std::to_string(normals) +
                                 " normals; give one for each vertex, or none");
  }
  if (uvs != 0 && uvs != positions) {
    throw Error(shape.where, "the mesh has " + std::to_string(positions) + " vertices but " + std::to_string(uvs) +
                                 " uvs; give one for each vertex, or none");
  }
}

void check_indices(const std::vector<std::uint32_t>& indices, std::size_t vertices, std::size_t corners, const Shape& shape) {
  if (indices.size() % corners != 0) {
    throw Error(shape.where, "the number of indices, " + std::to_string(indices.size()) + ", is not a multiple of " +
                                 std::to_string(corners) + "; complete the last face");
  }
  for (const std::uint32_t i : indices) {
    if (i >= vertices) {
      throw Error(shape.where, "index " + std::to_string(i) + " is out of range; the mesh has " + std::to_string(vertices) +
                                   " vertices, counted from 0");
    }
  }
}

template <typename Mesh>
PlacedMesh place(const Mesh& mesh, const Shape& shape, std::size_t corners) {
  check_counts(mesh.positions.size(), mesh.normals.size(), mesh.uvs.size(), shape);
  check_indices(mesh.indices, mesh.positions.size(), corners, shape);
  PlacedMesh placed;
  placed.uvs = &mesh.uvs;
  placed.indices = &mesh.indices;
  placed.flip = shape.reverse_orientation != shape.to_world.swaps_handedness();
  placed.positions.reserve(mesh.positions.size() + kPadding);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = shape.to_world.point(mesh.positions[i]);
    if (!is_finite(p)) throw Error(shape.where, "vertex " + std::to_string(i) + " is not finite; correct its coordinates");
    placed.positions.push_back(p);
  }
  placed.positions.resize(mesh.positions.size() + kPadding);
  placed.normals.reserve(mesh.normals.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const Vec3 n = shape.to_world.normal(mesh.normals[i]);  // its length weighs the interpolation, as in pbrt
    if (!is_finite(n)) throw Error(shape.where, "normal " + std::to_string(i) + " is not finite; correct its coordinates");
    placed.normals.push_back(shape.reverse_orientation ? -n : n);
  }
  return placed;
}

template <std::size_t N>
int orientation(const PlacedMesh& mesh, std::uint32_t primitive) {
  if (!mesh.normals.empty()) {
    const auto c = mesh.corners<N>(primitive);
    const Vec3d p0 = mesh.position(c[0]);
    const Vec3d winding = N == 3 ? cross(mesh.position(c[1]) - p0, mesh.position(c[2]) - p0)
                                 : cross(mesh.position(c[N - 1]) - p0, mesh.position(c[2]) - mesh.position(c[1]));
    Vec3d sum;
    for (const std::uint32_t i : c) sum = sum + Vec3d(mesh.normals[i]);
    const double side = dot(winding, sum);
    if (side != 0) return side > 0 ? 1 : -1;
  }
  return mesh.flip ? -1 : 1;
}

}  // namespace

PlacedMesh place_mesh(const TriangleMesh& mesh, const Shape& shape) { return place(mesh, shape, 3); }
PlacedMesh place_mesh(const BilinearMesh& mesh, const Shape& shape) { return place(mesh, shape, 4); }

int triangle_orientation(const PlacedMesh& mesh, std::uint32_t primitive) { return orientation<3>(mesh, primitive); }
int patch_orientation(const PlacedMesh& mesh, std::uint32_t primitive) { return orientation<4>(mesh, primitive); }

}  // namespace tyndall
