#include "io/loop_subdivision.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "unit/io/reader_checks.h"

using namespace tyndall;

namespace {

const std::vector<Vec3> kOctahedron{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
const std::vector<std::uint32_t> kOctahedronFaces{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

/// A flat grid of n x n squares in [0, 1]^2, each cut in two.
TriangleMesh grid(std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.push_back({float(x) / float(n), float(y) / float(n), 0});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  return mesh;
}

std::string error_of(const std::vector<Vec3>& p, const std::vector<std::uint32_t>& faces, int levels = 1) {
  return test::message_of([&] { subdivide_loop(p, faces, levels); });
}

}  // namespace

TEST_CASE("each level has four times the faces, and the limit does not depend on their number") {
  const TriangleMesh once = subdivide_loop(kOctahedron, kOctahedronFaces, 1);
  CHECK(once.indices.size() == 4 * kOctahedronFaces.size());
  CHECK(once.positions.size() == 6 + 12);
  const TriangleMesh more = subdivide_loop(kOctahedron, kOctahedronFaces, 4);
  CHECK(more.indices.size() == 256 * kOctahedronFaces.size());
  // Vertices keep their numbers. A corner of valence 4 tends to the same point from every level: beta is 3/32, so that the
  // weight of the ring, whose mean is the centre, is 4 / (4 + 3 / (8 beta)) = 1/2.
  for (std::size_t v = 0; v < kOctahedron.size(); ++v) {
    CHECK(length(once.positions[v] - kOctahedron[v] * 0.5f) < 1e-6f);
    CHECK(length(more.positions[v] - once.positions[v]) < 1e-6f);
    // The faces wind counterclockwise from outside; pbrt's normals point inside.
    CHECK(length(normalize(more.normals[v]) + kOctahedron[v]) < 1e-5f);
  }
}

TEST_CASE("a flat mesh stays flat, its straight edges straight and its corners rounded as a curve's") {
  const TriangleMesh coarse = grid(3), fine = subdivide_loop(coarse.positions, coarse.indices, 3);
  float low = 1;
  for (std::size_t v = 0; v < fine.positions.size(); ++v) {
    const Vec3 p = fine.positions[v];
    CHECK(p.z == 0);
    CHECK(length(normalize(fine.normals[v]) + Vec3{0, 0, 1}) < 1e-5f);
    CHECK(std::min({p.x, p.y, 1 - p.x, 1 - p.y}) > -1e-6f);
    low = std::min(low, p.x);
  }
  CHECK(low == 0);  // the middles of edges do not move
  // pbrt's normals are as long as the tangents' cross product. A ring of six, an affine regular hexagon, has 9 times the area
  // h^2 2/sqrt(3) of what spans it; the four of an edge 2h times 4h.
  const auto length_at = [&](Vec3 place) {
    const auto near = [&](const Vec3& a, const Vec3& b) { return length(a - place) < length(b - place); };
    const auto found = std::min_element(fine.positions.begin(), fine.positions.end(), near);
    return length(fine.normals[static_cast<std::size_t>(found - fine.positions.begin())]);
  };
  CHECK(length_at({0, 0.5f, 0}) / length_at({0.5f, 0.5f, 0}) == doctest::Approx(8 * std::sqrt(3.0) / 18).epsilon(1e-5));
  // The cubic B-spline's limit: 1/6 of each neighbour (here 1/3 away) and 2/3 of the corner; pbrt's last step of 1/5 from the
  // refined corner comes near.
  const Vec3 corner = fine.positions[0];
  CHECK(corner.x == doctest::Approx(1.0 / 18).epsilon(0.03));
  CHECK(corner.x == doctest::Approx(corner.y));
}

TEST_CASE("what is no manifold is refused, and what would be too large") {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  CHECK_CONTAINS(error_of(p, {0, 1, 2, 1, 0, 3, 0, 1, 4}), "more than two faces share the edge from vertex 0 to 1");
  CHECK_CONTAINS(error_of(p, {0, 1, 2, 0, 1, 3}), "wind in different directions");
  CHECK_CONTAINS(error_of(p, {0, 1, 1}), "face 0 with the same vertex twice");
  CHECK_CONTAINS(error_of(kOctahedron, kOctahedronFaces, 12), "use fewer levels");
  CHECK(subdivide_loop(p, {0, 1, 2}, 2).positions.size() == 5 + 3 + 9);  // unused vertices are carried along
}

TEST_CASE("the shape loopsubdiv") {
  const std::string shape = "Shape \"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"integer indices\" [0 1 2 2 1 3] ";
  const auto mesh = std::get<TriangleMesh>(test::read_world(shape + "\"integer levels\" 2").shapes.at(0).kind);
  CHECK(mesh.indices.size() == 2 * 16 * 3);
  CHECK(mesh.normals.size() == mesh.positions.size());
  CHECK(std::get<TriangleMesh>(test::read_world(shape).shapes.at(0).kind).indices.size() == 2 * 64 * 3);
  CHECK_CONTAINS(test::world_error(shape + "\"integer levels\" 13"), "levels must be from 0 to 12");
  CHECK_CONTAINS(test::world_error("Shape \"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 1]"),
                 "the same vertex twice");
}
