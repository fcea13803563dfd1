#include <doctest/doctest.h>

#include "geometry_scenes.h"
#include "surface/convex_boundary.h"
#include "surface/shape_mesh.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// Points on an ellipsoid, four of a tetrahedron first, each added to a hull by replacing the faces that it sees.
TriangleMesh random_hull(int points, Rng& rng) {
  const auto on_ball = [&] {
    Vec3d p;
    do p = {2.0 * rng.uniform() - 1, 2.0 * rng.uniform() - 1, 2.0 * rng.uniform() - 1};
    while (!(length(p) > 0.1 && length(p) < 1));
    return normalize(p);
  };
  std::vector<Vec3d> at{{0, 0, 1}, {0.9, 0, -0.4}, {-0.5, 0.8, -0.4}, {-0.5, -0.8, -0.4}};
  std::vector<std::array<std::uint32_t, 3>> faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  while (static_cast<int>(at.size()) < points) {
    const Vec3d p = on_ball();
    std::vector<std::array<std::uint32_t, 3>> kept;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> rim;
    for (const auto& f : faces) {
      if (dot(cross(at[f[1]] - at[f[0]], at[f[2]] - at[f[0]]), p - at[f[0]]) < 1e-3) {
        kept.push_back(f);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const std::pair back{f[(i + 1) % 3], f[i]};
        const auto known = std::find(rim.begin(), rim.end(), back);
        if (known == rim.end())
          rim.emplace_back(f[i], f[(i + 1) % 3]);
        else
          rim.erase(known);
      }
    }
    for (const auto& [a, b] : rim) kept.push_back({a, b, static_cast<std::uint32_t>(at.size())});
    faces = std::move(kept);
    at.push_back(p);
  }
  TriangleMesh mesh;
  for (const Vec3d& p : at) mesh.positions.push_back(to_vec3({p.x, 0.5 * p.y, 2 * p.z}));
  for (const auto& f : faces) mesh.indices.insert(mesh.indices.end(), f.begin(), f.end());
  return mesh;
}

struct Line {
  double enters = -kInfinity, leaves = kInfinity;
  int met = 0;
};

/// The oracle: one triangle after another, by the exact test.
Line met_by(const PlacedMesh& mesh, const ShapeRay& ray) {
  Line line;
  for (std::uint32_t i = 0; 3 * i < mesh.indices->size(); ++i) {
    const auto c = mesh.corners<3>(i);
    const auto root = intersect_triangle(ray, {mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2])});
    if (!root) continue;
    ++line.met;
    (root->facing < 0 ? line.enters : line.leaves) = root->t;
  }
  return line;
}

void check_against_triangles(const TriangleMesh& triangles, const Transform& place, float size, int rays) {
  const Shape shape = make_shape(triangles, place, kInterface);
  const PlacedMesh mesh = place_mesh(triangles, shape);
  const auto convex = ConvexBoundary::of(mesh);
  REQUIRE(convex);
  const Vec3 center = place.point({0, 0, 0});
  Rng rng(3);
  int met = 0, apart = 0, far = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray r = random_ray(rng, 1.5f * size, center);
    const ShapeRay ray{Vec3d(r.o), Vec3d(r.d)};
    const Line line = met_by(mesh, ray);
    const auto passage = convex->passage(ray);
    met += line.met > 0;
    apart += (line.met > 0) != passage.has_value();
    if (line.met == 0 || !passage) continue;
    const double rounding = 1e-6 * (size + length(Vec3(center))) / length(r.d);
    far += std::abs(line.enters - passage->enters) > rounding / passage->enters_cosine ||
           std::abs(line.leaves - passage->leaves) > rounding / passage->leaves_cosine;
  }
  CHECK(met > rays / 100);       // thin ones are hard to meet
  CHECK(apart <= rays / 10000);  // lines that graze an edge within its rounding
  CHECK(far == 0);
}

bool is_convex(const TriangleMesh& mesh) { return ConvexBoundary::of(place_mesh(mesh, make_shape(mesh))).has_value(); }

}  // namespace

TEST_CASE("convex boundaries are met where their triangles are") {
  for (const double offset : {0.0, 1000.0}) {
    const Transform move = Transform::translate(offset, -offset, offset);
    check_against_triangles(box_mesh(), move, 1, 100000);
    check_against_triangles(box_mesh(), move * Transform::rotate(30, 1, 2, 3) * Transform::scale(1, 0.01, 30), 30, 100000);
  }
  Rng rng(5);
  for (const int points : {4, 6, 10, 17}) check_against_triangles(random_hull(points, rng), {}, 2, 100000);
}

TEST_CASE("whether a convex boundary holds a point does not depend on the ray that asks") {
  const TriangleMesh box = box_mesh();
  const Transform place = Transform::translate(300, 20, -7) * Transform::rotate(40, 3, 1, 2);
  const auto convex = ConvexBoundary::of(place_mesh(box, make_shape(box, place)));
  REQUIRE(convex);
  Rng rng(8);
  const auto number = [&] { return 2 * rng.uniform() - 1; };
  int inside = 0, disagree = 0;
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) {
    // As near to a face as single precision gets.
    const Vec3d p(place.point({number(), number(), rng.uniform() < 0.5f ? 1.0f : -1.0f}));
    const auto holds = [&](Vec3 d) {
      const auto passage = convex->passage({p, Vec3d(d)});
      return passage && passage->enters < 0 && passage->leaves > 0;
    };
    const bool first = holds({number(), number(), number()});
    inside += first;
    for (int k = 0; k < 16; ++k) disagree += holds({number(), number(), number()}) != first;
  }
  CHECK(inside > kPoints / 10);
  CHECK(inside < kPoints * 9 / 10);
  CHECK(disagree == 0);
}

TEST_CASE("meshes that are open, bent inward, flat, double or many are not taken for convex") {
  CHECK(is_convex(box_mesh()));
  TriangleMesh mesh = box_mesh();
  mesh.indices.resize(33);
  CHECK(!is_convex(mesh));  // open
  mesh = box_mesh();
  mesh.positions[3] = {0.9f, 0.9f, -0.9f};
  CHECK(!is_convex(mesh));  // a corner pushed in, whose faces fold through it
  mesh = box_mesh();
  for (Vec3& p : mesh.positions) p.z = 0;
  CHECK(!is_convex(mesh));  // flat
  mesh = box_mesh();
  mesh.indices.insert(mesh.indices.end(), mesh.indices.begin(), mesh.indices.begin() + 36);
  CHECK(!is_convex(mesh));  // twice
  mesh = box_mesh();
  std::swap(mesh.indices[1], mesh.indices[2]);
  CHECK(!is_convex(mesh));  // a triangle turned
  CHECK(!is_convex(bumpy_ball(16)));
}

TEST_CASE("one boundary among few and among many is the same") {
  const auto crossings_of_first = [](int boxes) {
    Scene scene = empty_scene();
    for (int i = 0; i < boxes; ++i) {
      const Transform place = Transform::translate(0, 0, 10.0 * i) * Transform::rotate(20, 1, 1, 0);
      if (i > 0) scene.boundaries.push_back(scene.boundaries[0]);
      scene.shapes.push_back(make_shape(box_mesh(), place, kInterface));
      scene.shapes.back().boundary = static_cast<BoundaryId>(i);
    }
    const Geometry geometry(scene, nullptr, 1);
    Rng rng(6);
    std::vector<Crossing> found;
    for (int i = 0; i < 20000; ++i) {
      for (const Crossing& c : geometry.trace_all(random_ray(rng, 1.5f, {}), 0, 4)) found.push_back(c);
    }
    return found;
  };
  const auto few = crossings_of_first(1), many = crossings_of_first(40);
  REQUIRE(few.size() > 5000);
  REQUIRE(few.size() == many.size());
  for (std::size_t i = 0; i < few.size(); ++i) {
    CHECK(few[i].group == many[i].group);
    CHECK(few[i].sign == many[i].sign);
    CHECK(few[i].t == doctest::Approx(many[i].t).epsilon(1e-5));
  }
}
