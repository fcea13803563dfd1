#include "io/loop_subdivision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "math/vec3d.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;
constexpr std::size_t kMostFaces = std::size_t{1} << 24;

std::uint32_t next(std::uint32_t corner) { return (corner + 1) % 3; }
std::uint32_t previous(std::uint32_t corner) { return (corner + 2) % 3; }

Error bad_mesh(const std::string& what) { return Error(Failure::scene, "mesh " + what); }

/// The neighbours of a vertex in order, from one boundary edge to the other or all around.
struct Ring {
  std::vector<Vec3d> p;
  bool is_open = false;
};

class LoopMesh {
 public:
  LoopMesh(std::vector<Vec3d> positions, std::vector<std::array<std::uint32_t, 3>> faces)
      : positions_(std::move(positions)), faces_(std::move(faces)) {
    connect();
  }

  LoopMesh refined() const;
  TriangleMesh at_limit() const;

 private:
  struct Edge {
    std::uint32_t low, high, face, corner;  ///< of the face it goes from `corner` to the next
    std::tuple<std::uint32_t, std::uint32_t> ends() const { return {low, high}; }
  };

  void connect();
  std::uint32_t corner_of(std::uint32_t face, std::uint32_t vertex) const {
    const auto& f = faces_[face];
    return f[0] == vertex ? 0 : f[1] == vertex ? 1 : 2;
  }
  std::uint32_t face_at(const Edge& e) const { return across_[e.face][e.corner]; }
  Ring ring(std::uint32_t vertex) const;
  Vec3d even(std::uint32_t vertex) const;
  Vec3d odd(const Edge& edge) const;
  Vec3d limit(std::uint32_t vertex) const;
  Vec3d normal(std::uint32_t vertex) const;

  std::vector<Vec3d> positions_;
  std::vector<std::array<std::uint32_t, 3>> faces_;
  std::vector<std::array<std::uint32_t, 3>> across_;  ///< the face beyond the edge from each corner; kNone: boundary
  std::vector<std::uint32_t> face_of_;                ///< a face of each vertex; kNone: in none
  std::vector<Edge> edges_;                           ///< one for each pair of ends
};

/// Finds each face's neighbours.
void LoopMesh::connect() {
  face_of_.assign(positions_.size(), kNone);
  across_.assign(faces_.size(), {kNone, kNone, kNone});
  edges_.reserve(3 * faces_.size());
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t a = faces_[f][c], b = faces_[f][next(c)];
      if (a == b) throw bad_mesh("has face " + std::to_string(f) + " with the same vertex twice; remove it");
      edges_.push_back({std::min(a, b), std::max(a, b), f, c});
      face_of_[a] = f;
    }
  }
  std::stable_sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.ends() < b.ends(); });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges_.size();) {
    std::size_t end = i + 1;
    while (end < edges_.size() && edges_[end].ends() == edges_[i].ends()) ++end;
    const Edge a = edges_[i];
    const auto name = [&] { return "edge from vertex " + std::to_string(a.low) + " to " + std::to_string(a.high); };
    if (end - i > 2) throw bad_mesh("is no surface: more than two faces share the " + name() + "; take it apart");
    if (end - i == 2) {
      const Edge b = edges_[i + 1];
      if (faces_[a.face][a.corner] == faces_[b.face][b.corner])
        throw bad_mesh("has faces on both sides of the " + name() + " that wind in different directions; turn one");
      across_[a.face][a.corner] = b.face;
      across_[b.face][b.corner] = a.face;
    }
    edges_[kept++] = a;
    i = end;
  }
  edges_.resize(kept);
}

Ring LoopMesh::ring(std::uint32_t vertex) const {
  Ring ring;
  const std::uint32_t start = face_of_[vertex];
  std::uint32_t face = start;
  do {
    ring.p.push_back(positions_[faces_[face][next(corner_of(face, vertex))]]);
    const std::uint32_t beyond = across_[face][corner_of(face, vertex)];
    if (beyond == kNone) {  // from this boundary edge the other way round
      ring.p = {ring.p.back()};
      ring.is_open = true;
      for (; face != kNone; face = across_[face][previous(corner_of(face, vertex))])
        ring.p.push_back(positions_[faces_[face][previous(corner_of(face, vertex))]]);
      return ring;
    }
    face = beyond;
  } while (face != start);
  return ring;
}

/// Warren's weight, which is Loop's up to a smooth factor: 3/(8n), and 3/16 at valence 3 [Warren and Weimer 2002].
double beta(std::size_t valence) { return valence == 3 ? 3.0 / 16 : 3.0 / (8 * static_cast<double>(valence)); }

Vec3d blend(Vec3d p, const Ring& ring, double weight) {
  Vec3d sum = p * (1 - static_cast<double>(ring.p.size()) * weight);
  for (const Vec3d& q : ring.p) sum = sum + q * weight;
  return sum;
}

Vec3d blend_ends(Vec3d p, const Ring& ring, double weight) {
  return p * (1 - 2 * weight) + (ring.p.front() + ring.p.back()) * weight;
}

Vec3d LoopMesh::even(std::uint32_t vertex) const {
  const Vec3d p = positions_[vertex];
  if (face_of_[vertex] == kNone) return p;
  const Ring r = ring(vertex);
  if (r.is_open) return blend_ends(p, r, 1.0 / 8);
  return blend(p, r, r.p.size() == 6 ? 1.0 / 16 : beta(r.p.size()));
}

Vec3d LoopMesh::odd(const Edge& e) const {
  const Vec3d ends = positions_[e.low] + positions_[e.high];
  const std::uint32_t beyond = face_at(e);
  if (beyond == kNone) return ends * 0.5;
  const auto opposite = [&](std::uint32_t face) {
    for (const std::uint32_t v : faces_[face])
      if (v != e.low && v != e.high) return positions_[v];
    return Vec3d();
  };
  return ends * (3.0 / 8) + (opposite(e.face) + opposite(beyond)) * (1.0 / 8);
}

LoopMesh LoopMesh::refined() const {
  std::vector<Vec3d> positions;
  positions.reserve(positions_.size() + edges_.size());
  for (std::uint32_t v = 0; v < positions_.size(); ++v) positions.push_back(even(v));
  std::vector<std::array<std::uint32_t, 3>> middle(faces_.size());  // of the edge from each corner
  for (const Edge& e : edges_) {
    const auto id = static_cast<std::uint32_t>(positions.size());
    positions.push_back(odd(e));
    middle[e.face][e.corner] = id;
    const std::uint32_t beyond = face_at(e);
    if (beyond == kNone) continue;
    const std::uint32_t from = faces_[e.face][next(e.corner)];  // there the edge begins at its other end
    middle[beyond][corner_of(beyond, from)] = id;
  }
  std::vector<std::array<std::uint32_t, 3>> faces;
  faces.reserve(4 * faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      std::array<std::uint32_t, 3> child;
      child[c] = faces_[f][c];
      child[next(c)] = middle[f][c];
      child[previous(c)] = middle[f][previous(c)];
      faces.push_back(child);
    }
    faces.push_back(middle[f]);
  }
  return {std::move(positions), std::move(faces)};
}

/// Where the vertex would come to after endless refinement.
Vec3d LoopMesh::limit(std::uint32_t vertex) const {
  const Vec3d p = positions_[vertex];
  if (face_of_[vertex] == kNone) return p;
  const Ring r = ring(vertex);
  if (r.is_open) return blend_ends(p, r, 1.0 / 5);
  const auto valence = static_cast<double>(r.p.size());
  return blend(p, r, 1 / (valence + 3 / (8 * beta(r.p.size()))));
}

/// Cross product of two tangents of the limit surface [Hoppe et al. 1994, app. A]; of vertices at the limit, as pbrt takes it.
Vec3d LoopMesh::normal(std::uint32_t vertex) const {
  if (face_of_[vertex] == kNone) return {};
  const Vec3d p = positions_[vertex];
  const Ring r = ring(vertex);
  const std::size_t n = r.p.size();
  Vec3d s, t;
  if (!r.is_open) {
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
      s = s + r.p[k] * std::cos(angle);
      t = t + r.p[k] * std::sin(angle);
    }
    return cross(s, t);
  }
  s = r.p[n - 1] - r.p[0];  // along the boundary; t leads away from it
  if (n == 2) {
    t = r.p[0] + r.p[1] - p * 2;
  } else if (n == 3) {
    t = r.p[1] - p;
  } else if (n == 4) {
    t = (r.p[1] + r.p[2]) * 2 - r.p[0] - r.p[3] - p * 2;
  } else {
    const double theta = std::numbers::pi / static_cast<double>(n - 1);
    t = (r.p[0] + r.p[n - 1]) * -std::sin(theta);
    for (std::size_t k = 1; k + 1 < n; ++k)
      t = t + r.p[k] * ((2 - 2 * std::cos(theta)) * std::sin(static_cast<double>(k) * theta));
  }
  return cross(s, t);
}

TriangleMesh LoopMesh::at_limit() const {
  LoopMesh moved = *this;
  for (std::uint32_t v = 0; v < positions_.size(); ++v) moved.positions_[v] = limit(v);
  // pbrt interpolates the cross products as they are: what counts of their lengths are the ratios.
  std::vector<Vec3d> normals;
  double longest = 0;
  for (std::uint32_t v = 0; v < positions_.size(); ++v)
    longest = std::max(longest, length(normals.emplace_back(moved.normal(v))));
  TriangleMesh mesh;
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    mesh.positions.push_back(to_vec3(moved.positions_[v]));
    mesh.normals.push_back(to_vec3(longest > 0 ? normals[v] / longest : normals[v]));
  }
  for (const auto& face : faces_) mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
  return mesh;
}

}  // namespace

TriangleMesh subdivide_loop(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& indices, int levels) {
  std::size_t faces = indices.size() / 3;
  for (int i = 0; i < levels; ++i) {
    faces *= 4;
    if (faces > kMostFaces) throw bad_mesh("would have more than " + std::to_string(kMostFaces) + " faces; use fewer levels");
  }
  std::vector<std::array<std::uint32_t, 3>> triangles(indices.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i] = {indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]};
  LoopMesh mesh(std::vector<Vec3d>(positions.begin(), positions.end()), std::move(triangles));
  for (int i = 0; i < levels; ++i) mesh = mesh.refined();
  return mesh.at_limit();
}

}  // namespace tyndall
