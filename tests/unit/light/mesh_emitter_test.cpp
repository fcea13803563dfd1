#include <doctest/doctest.h>

#include "emitter_check.h"
#include "light/patch_emitter.h"
#include "light/triangle_emitter.h"
#include "math/rng.h"

namespace tyndall {
namespace {

Vec3d transformed(const Transform& t, Vec3 p) { return Vec3d(t.point(p)); }

/// A triangle over the half u + v < 1 of the unit square.
test::EmitterUnderTest triangle(std::string name, std::array<Vec3, 3> p, const Transform& to_world, bool reversed = false) {
  TriangleMesh mesh{{p[0], p[1], p[2]}, {}, {{0, 0}, {1, 0}, {0, 1}}, {0, 1, 2}};
  const auto e = std::make_shared<TriangleEmitter>(mesh, to_world, reversed, true);
  const Vec3d a = transformed(to_world, p[0]), b = transformed(to_world, p[1]), c = transformed(to_world, p[2]);
  const double sign = reversed != to_world.swaps_handedness() ? -1 : 1;
  return {std::move(name), [=](Vec3 q, Vec2 u) { return e->sample(0, q, u); },
          [=](Vec3 q, Vec3 hit) { return e->pdf(0, q, hit); },
          [=](double u, double v) -> std::optional<test::SurfacePoint> {
            if (u + v > 1 + 1e-6) return std::nullopt;
            const double share = u + v > 1 - 1e-6 ? 0.5 : 1;  // a cell of the quadrature that lies across the edge
            return test::SurfacePoint{a + (b - a) * u + (c - a) * v, cross(b - a, c - a) * (sign * share)};
          }};
}

test::EmitterUnderTest patch(std::string name, std::array<Vec3, 4> p, const Transform& to_world, bool reversed = false) {
  BilinearMesh mesh{{p[0], p[1], p[2], p[3]}, {}, {}, {0, 1, 2, 3}};
  const auto e = std::make_shared<PatchEmitter>(mesh, to_world, reversed, true);
  std::array<Vec3d, 4> q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = transformed(to_world, p[i]);
  const double sign = reversed != to_world.swaps_handedness() ? -1 : 1;
  return {std::move(name), [=](Vec3 x, Vec2 u) { return e->sample(0, x, u); },
          [=](Vec3 x, Vec3 hit) { return e->pdf(0, x, hit); },
          [=](double u, double v) -> std::optional<test::SurfacePoint> {
            const Vec3d x = (q[0] * (1 - u) + q[1] * u) * (1 - v) + (q[2] * (1 - u) + q[3] * u) * v;
            const Vec3d du = (q[1] - q[0]) * (1 - v) + (q[3] - q[2]) * v, dv = (q[2] - q[0]) * (1 - u) + (q[3] - q[1]) * u;
            return test::SurfacePoint{x, cross(du, dv) * sign};
          }};
}

const Transform kPlain;
const Transform kSkewed = Transform::translate(0.3, -0.2, 0.1) * Transform::rotate(37, 1, 2, 3) * Transform::scale(2, 0.5, 1);
const Transform kMirrored = Transform::scale(-1, 1, 1) * Transform::rotate(20, 0, 1, 1);

TEST_CASE("emissive triangles are sampled as their density says") {
  const std::array<Vec3, 3> flat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.2f, 0.8f, 0}};
  for (const auto& e : {triangle("plain", flat, kPlain), triangle("skewed", flat, kSkewed),
                        triangle("mirrored", flat, kMirrored), triangle("reversed", flat, kPlain, true)})
    for (const Vec3 p : {Vec3{0.3f, 0.3f, 1}, Vec3{2, -1, 0.4f}, Vec3{0.4f, 0.2f, -0.3f}, Vec3{-30, 20, 50}})
      test::check_emitter(e, p, normalize(Vec3{0.1f, 0.2f, 0} - p), 8, 60);
}

TEST_CASE("emissive triangles too small or too near for solid angles are sampled by area") {
  const auto tiny = triangle("tiny", {Vec3{0, 0, 0}, Vec3{1e-5f, 0, 0}, Vec3{0, 1e-5f, 0}}, kPlain);
  test::check_emitter(tiny, {0, 0, 10}, {0, 0, -1});
  const auto huge = triangle("huge", {Vec3{-3e4f, -3e4f, 0}, Vec3{3e4f, -3e4f, 0}, Vec3{0, 6e4f, 0}}, kPlain);
  const auto s = huge.sample({0, 0, 0.3f}, {0.3f, 0.7f});
  REQUIRE(s);
  CHECK(huge.pdf({0, 0, 0.3f}, Vec3{0, 0, 0.3f} + s->wi * s->distance) == doctest::Approx(s->pdf).epsilon(1e-2));
}

TEST_CASE("emissive triangles are sampled by area when they are far off, and each way up to where that begins") {
  const std::array<Vec3, 3> needle{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5f, 0.05f, 0.1f}};
  const std::array<Vec3, 3> flat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.2f, 0.8f, 0}};
  for (const auto& e : {triangle("flat", flat, kPlain), triangle("needle", needle, kPlain), triangle("skewed", flat, kSkewed)})
    for (const Vec3 p : {Vec3{0, 0, 4.9f}, Vec3{0, 0, 5.1f}, Vec3{4, 0.2f, 3.5f}, Vec3{20, -3, 0.7f}})
      test::check_emitter(e, p, normalize(Vec3{0.1f, 0.2f, 0} - p), 8, 60);
}

TEST_CASE("a triangle gives nothing edge-on, and nothing at all without area") {
  const auto e = triangle("plain", {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}, kPlain);
  CHECK(!e.sample({3, 3, 0}, {0.3f, 0.3f}));
  CHECK(!e.sample({0.2f, 0.2f, 0}, {0.3f, 0.3f}));
  const auto flat = triangle("degenerate", {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}}, kPlain);
  CHECK(!flat.sample({0, 0, 1}, {0.3f, 0.3f}));
  CHECK(flat.pdf({0, 0, 1}, {1, 0, 0}) == 0);
}

TEST_CASE("vertex normals choose the side a triangle emits from") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, -1}, {0, 0, -1}, {0, 0, -1}}, {}, {0, 1, 2}};
  CHECK(TriangleEmitter(mesh, kPlain, false, false).extent(0).normals.axis.z == -1);
  CHECK(TriangleEmitter(mesh, kPlain, true, false).extent(0).normals.axis.z == 1);
}

TEST_CASE("emissive rectangles are sampled as their density says") {
  const std::array<Vec3, 4> square{Vec3{-0.5f, -0.5f, 0}, Vec3{0.5f, -0.5f, 0}, Vec3{-0.5f, 0.5f, 0}, Vec3{0.5f, 0.5f, 0}};
  const Transform turned = Transform::rotate(30, 1, 1, 0) * Transform::scale(3, 0.4, 1);
  for (const auto& e : {patch("plain", square, kPlain), patch("turned", square, turned), patch("mirrored", square, kMirrored)})
    for (const Vec3 p : {Vec3{0.1f, 0.2f, 1}, Vec3{0.3f, 0.1f, -0.2f}, Vec3{2, 1, 0.6f}, Vec3{-300, 20, 100}})
      test::check_emitter(e, p, normalize(-p));
  test::check_emitter(patch("far", square, kPlain), {0, 1e5f, 1e5f}, normalize(Vec3{0, -1, -1}));
}

TEST_CASE("emissive patches that are no rectangles are sampled as their density says") {
  const std::array<std::array<Vec3, 4>, 5> shapes{{
      {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.4f, 1, 0}, Vec3{1.4f, 1, 0}},        // parallelogram
      {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0.5f, 1, 0}, Vec3{1, 1, 0}},           // trapezium
      {Vec3{0, 0, 0}, Vec3{1, 0, 0.5f}, Vec3{0, 1, 0.4f}, Vec3{1, 1, -0.3f}},    // saddle
      {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.3f, 1, 0}, Vec3{0.3f, 1, 0}},        // triangle
      {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.1f, 0.2f, 0}, Vec3{1.5f, 1.8f, 0}},  // strongly uneven
  }};
  int i = 0;
  for (const auto& shape : shapes)
    for (const auto& [t, what] :
         {std::pair{kPlain, " plain"}, std::pair{kSkewed, " skewed"}, std::pair{kMirrored, " mirrored"}})
      for (const Vec3 p : {Vec3{0.5f, 0.4f, 2}, Vec3{3, 1, -2}})
        test::check_emitter(patch("shape " + std::to_string(i++ / 6) + what, shape, t), p, normalize(Vec3{0.5f, 0.5f, 0} - p));
}

TEST_CASE("areas and extents of patches") {
  const BilinearMesh mesh{{{0, 0, 0}, {2, 0, 0}, {0.5f, 1, 0}, {1, 1, 0}}, {}, {}, {0, 1, 2, 3}};
  const PatchEmitter e(mesh, kPlain, false, false);
  CHECK(e.area(0) == doctest::Approx(1.25).epsilon(1e-12));
  CHECK(e.extent(0).normals.theta < 1e-4f);
  CHECK(e.extent(0).normals.axis.z == 1);
}

TEST_CASE("a triangle gives no light to points of its own plane, where rounding has put them") {
  Rng rng(21);
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&] { return 20 * rng.uniform() - 10; };
    const TriangleMesh mesh{
        {{number(), number(), number()}, {number(), number(), number()}, {number(), number(), number()}}, {}, {}, {0, 1, 2}};
    const TriangleEmitter e(mesh, {}, false, false);
    const auto& p = mesh.positions;
    // Inside, often next to an edge, and on the neighbour beyond an edge.
    const float u = i % 3 == 0 ? 1e-4f * rng.uniform() : (i % 3 == 1 ? -0.2f * rng.uniform() : 0.5f * rng.uniform()),
                v = 0.5f * rng.uniform();
    const Vec3 q = to_vec3(Vec3d(p[0]) + (Vec3d(p[1]) - Vec3d(p[0])) * double(u) + (Vec3d(p[2]) - Vec3d(p[0])) * double(v));
    REQUIRE(!e.sample(0, q, {rng.uniform(), rng.uniform()}));
    REQUIRE(e.pdf(0, q, p[0] * 0.3f + p[1] * 0.3f + p[2] * 0.4f) == 0);
    // A little above there is light.
    const Vec3 above = q + e.extent(0).normals.axis * 1e-3f;
    REQUIRE(e.sample(0, above, {rng.uniform(), rng.uniform()}));
  }
}

// Turned in every direction, so that all corners of some lie in no plane of floats.
TEST_CASE("a rectangle gives no light to points of its own plane, where rounding has put them") {
  Rng rng(22);
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&] { return 20 * rng.uniform() - 10; };
    const Transform t =
        Transform::translate(number(), number(), number()) * Transform::rotate(18 * number(), number(), number(), number());
    const BilinearMesh mesh{{{-1, -2, 0}, {1, -2, 0}, {-1, 2, 0}, {1, 2, 0}}, {}, {}, {0, 1, 2, 3}};
    const PatchEmitter e(mesh, t, false, false);
    const auto on_plane = [&](float u, float v) { return t.point(Vec3{2 * u - 1, 4 * v - 2, 0}); };
    const Vec3 q = on_plane(i % 2 == 0 ? rng.uniform() : 1.2f, rng.uniform());
    REQUIRE(!e.sample(0, q, {rng.uniform(), rng.uniform()}));
    REQUIRE(e.pdf(0, q, on_plane(0.4f, 0.3f)) == 0);
    const Vec3 above = q + e.extent(0).normals.axis * 1e-3f;
    REQUIRE(e.sample(0, above, {rng.uniform(), rng.uniform()}));
  }
}

}  // namespace
}  // namespace tyndall
