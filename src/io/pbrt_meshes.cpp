#include "io/pbrt_meshes.h"

#include <numeric>
#include <string>
#include <utility>

#include "io/loop_subdivision.h"
#include "io/ply.h"
#include "tyndall/frames.h"

namespace tyndall::pbrt {
namespace {

std::string count(std::size_t n) { return std::to_string(n); }

/// Indices of `corners` a face; a mesh of a single face may leave them out.
std::vector<std::uint32_t> read_indices(ParamList& params, std::size_t vertices, std::size_t corners) {
  const std::vector<std::int32_t> given = params.integers("indices");
  std::vector<std::uint32_t> indices(given.size());
  if (given.empty()) {
    if (vertices != corners)
      throw params.error("mesh of " + count(vertices) + " vertices has no indices; add \"integer indices\"");
    indices.resize(corners);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
  }
  if (given.size() % corners != 0)
    throw params.error("indices", count(given.size()) + " indices are no multiple of " + count(corners) + "; each face takes " +
                                      count(corners));
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] < 0 || static_cast<std::size_t>(given[i]) >= vertices)
      throw params.error("indices", "index " + std::to_string(given[i]) + " (the " + count(i + 1) +
                                        ". of the list) is out of range; the mesh has " + count(vertices) +
                                        " vertices, counted from 0");
    indices[i] = static_cast<std::uint32_t>(given[i]);
  }
  return indices;
}

void check_per_vertex(ParamList& params, std::string_view name, std::size_t given, std::size_t vertices) {
  if (given != 0 && given != vertices)
    throw params.error(name, "\"" + std::string(name) + "\" has " + count(given) + " values for " + count(vertices) +
                                 " vertices; give one for each");
}

template <typename Mesh>
Mesh read_mesh(ParamList& params, std::size_t corners) {
  Mesh mesh;
  mesh.positions = params.triples("P", ParamType::point3);
  if (mesh.positions.empty()) throw params.error("mesh has no vertices; add \"point3 P\"");
  mesh.indices = read_indices(params, mesh.positions.size(), corners);
  mesh.normals = params.triples("N", ParamType::normal);
  mesh.uvs = params.pairs("uv");
  check_per_vertex(params, "N", mesh.normals.size(), mesh.positions.size());
  check_per_vertex(params, "uv", mesh.uvs.size(), mesh.positions.size());
  params.ignore("faceIndices", {ParamType::integer}, "nothing looks them up");
  return mesh;
}

}  // namespace

TriangleMesh read_triangle_mesh(ParamList& params) {
  params.ignore("S", {ParamType::vector3}, "tangents come from uv");
  return read_mesh<TriangleMesh>(params, 3);
}

TriangleMesh read_loop_subdivision(ParamList& params) {
  constexpr int kMostLevels = 12;
  const int levels = params.integer("levels", 3);
  if (levels < 0 || levels > kMostLevels)
    throw params.error("levels", "levels must be from 0 to " + std::to_string(kMostLevels) + "; each has four times the faces");
  params.string("scheme", "loop");
  const std::vector<Vec3> positions = params.triples("P", ParamType::point3);
  if (positions.empty()) throw params.error("mesh has no vertices; add \"point3 P\"");
  const std::vector<std::uint32_t> indices = read_indices(params, positions.size(), 3);
  try {
    return subdivide_loop(positions, indices, levels);
  } catch (const Error& e) {
    throw params.error("indices", e.what());
  }
}

BilinearMesh read_bilinear_mesh(ParamList& params) {
  params.ignore("emissionfilename", {ParamType::string}, "it only guides sampling; give the image to AreaLightSource");
  return read_mesh<BilinearMesh>(params, 4);
}

std::vector<decltype(Shape::kind)> read_ply_mesh(State& state, ParamList& params) {
  const Location where = params.where("filename");
  const std::string path = resolve_asset(state, where, params.string("filename", ""));
  params.ignore("displacement", {ParamType::texture}, "surfaces are not displaced");
  params.ignore("edgelength", {ParamType::number}, "surfaces are not displaced");
  PlyMesh ply;
  try {
    // The scene has its own, so that only what may be asked for again is held twice.
    ply = state.how.kept ? *state.how.kept->get<PlyMesh>({path, "mesh"}, [&] { return read_ply(path); }) : read_ply(path);
  } catch (const Error& e) {
    throw Error(where, e.what());
  }
  if (ply.broken_normals > 0)
    params.reports().warn(where, path + ": " + count(ply.broken_normals) +
                                     " normals are NaN or infinite and left out; where a face has no other, it is flat");
  std::vector<decltype(Shape::kind)> kinds;
  if (!ply.triangles.empty() && !ply.quads.empty())
    kinds.emplace_back(TriangleMesh{ply.positions, ply.normals, ply.uvs, std::move(ply.triangles)});
  else if (!ply.triangles.empty())
    kinds.emplace_back(
        TriangleMesh{std::move(ply.positions), std::move(ply.normals), std::move(ply.uvs), std::move(ply.triangles)});
  if (!ply.quads.empty())
    kinds.emplace_back(
        BilinearMesh{std::move(ply.positions), std::move(ply.normals), std::move(ply.uvs), std::move(ply.quads)});
  return kinds;
}

}  // namespace tyndall::pbrt
