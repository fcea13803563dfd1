#include <doctest/doctest.h>

#include <xmmintrin.h>

#include <algorithm>
#include <ctime>

#include "geometry_scenes.h"
#include "texture/textures.h"

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("triangles: nearest hit, orientation, uv and tangent under any transform") {
  Rng rng(2);
  for (const Transform& to_world : trial_transforms()) {
    for (const bool reverse : {false, true}) {
      for (const bool boundary : {false, true}) {  // boundaries take another path
        Scene scene = empty_scene();
        Shape shape = make_shape(bumpy_ball(12), to_world);
        shape.reverse_orientation = reverse;
        if (boundary) shape.boundary = 0;
        scene.shapes.push_back(shape);
        const auto& mesh = std::get<TriangleMesh>(scene.shapes[0].kind);
        const Geometry geometry(scene, nullptr, 1);
        CHECK(geometry.triangle_count() == mesh.indices.size() / 3);
        for (int i = 0; i < 200; ++i) {
          const Ray local = random_ray(rng, 1);
          const Ray ray{to_world.point(local.o), to_world.vector(local.d)};
          double best = 1e30;
          Vec3d normal;
          for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {  // Moller-Trumbore on every triangle
            const Vec3d a(to_world.point(mesh.positions[mesh.indices[k]])),
                b(to_world.point(mesh.positions[mesh.indices[k + 1]])), c(to_world.point(mesh.positions[mesh.indices[k + 2]]));
            const Vec3d d(ray.d), s = Vec3d(ray.o) - a, q = cross(s, b - a), pv = cross(d, c - a);
            const double det = dot(b - a, pv), u = dot(s, pv) / det, v = dot(d, q) / det, t = dot(c - a, q) / det;
            if (u < 0 || v < 0 || u + v > 1 || t <= 0 || t >= best) continue;
            best = t;
            normal = normalize(cross(b - a, c - a)) * (to_world.swaps_handedness() ? -1 : 1);
          }
          const auto hit = geometry.trace(ray, 0, kInfinity).hit;
          REQUIRE(hit.has_value() == (best < 1e30));
          if (!hit) continue;
          CHECK(hit->t == doctest::Approx(best).epsilon(1e-5));
          CHECK(dot(hit->ng, to_vec3(normal)) * (reverse ? -1 : 1) > 0.999f);
          CHECK(length(hit->p - ray.at(hit->t)) < 1e-5f * (1 + length(ray.o)));
          CHECK(hit->group == (boundary ? 0u : kNone));
        }
      }
    }
  }
}

TEST_CASE("a triangle's default and given uvs, and shading normals that decide the side") {
  Scene scene = empty_scene();
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}};
  mesh.indices = {0, 1, 2};
  const auto trace = [&] { return *Geometry(scene, nullptr, 1).trace({{1.5f, 0.5f, 1}, {0, 0, -1}}, 0, kInfinity).hit; };
  scene.shapes = {make_shape(mesh)};
  SurfaceHit hit = trace();
  CHECK(hit.uv.x == doctest::Approx(0.75));
  CHECK(hit.uv.y == doctest::Approx(0.25));
  CHECK(hit.dpdu.x == doctest::Approx(2));
  CHECK(hit.dpdu.y == doctest::Approx(0));
  CHECK(hit.ng.z == doctest::Approx(1));
  CHECK(hit.barycentric.x == doctest::Approx(0.5));
  CHECK(hit.barycentric.y == doctest::Approx(0.25));

  mesh.uvs = {{0, 0}, {0, 0}, {0, 0}};  // degenerate: any tangent in the plane
  scene.shapes = {make_shape(mesh)};
  hit = trace();
  CHECK(length(hit.dpdu) > 0.5f);
  CHECK(std::abs(hit.dpdu.z) < 1e-6f);

  mesh.uvs = {};
  mesh.normals = {{0, 0, -1}, {0.6f, 0, -0.8f}, {0, 0, -1}};
  scene.shapes = {make_shape(mesh)};
  hit = trace();
  CHECK(hit.ng.z == doctest::Approx(-1));
  CHECK(length(hit.ns - normalize(Vec3{0.3f, 0, -0.9f})) < 1e-5f);
  CHECK(std::abs(dot(hit.dpdu, hit.ns)) < 1e-5f);
  scene.shapes[0].reverse_orientation = true;
  CHECK(trace().ng.z == doctest::Approx(1));
}

TEST_CASE("bilinear patches, planar and twisted, agree with a fine triangulation") {
  Rng rng(3);
  BilinearMesh mesh;
  mesh.indices = {0, 1, 2, 3};
  for (const float twist : {0.f, 0.9f}) {
    mesh.positions = {{-1, -1, twist}, {1, -0.7f, -twist}, {-1, 1, -twist}, {1, 1, twist}};
    if (twist == 0) mesh.positions[1].y = -1;
    const auto point = [&](float u, float v) {
      return (mesh.positions[0] * (1 - v) + mesh.positions[2] * v) * (1 - u) +
             (mesh.positions[1] * (1 - v) + mesh.positions[3] * v) * u;
    };
    TriangleMesh fine;
    constexpr std::uint32_t n = 96;
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i) fine.positions.push_back(point(float(i) / n, float(j) / n));
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
        fine.indices.insert(fine.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
      }
    }
    for (const Transform& to_world : trial_transforms()) {
      Scene patch_scene = empty_scene(), fine_scene = empty_scene();
      patch_scene.shapes.push_back(make_shape(mesh, to_world));
      fine_scene.shapes.push_back(make_shape(fine, to_world));
      const Geometry patch(patch_scene, nullptr, 1), reference(fine_scene, nullptr, 1);
      int different = 0, hits = 0;
      for (int i = 0; i < 2000; ++i) {
        const Ray local = random_ray(rng, 1);
        const Ray ray{to_world.point(local.o), to_world.vector(local.d)};
        const auto a = patch.trace(ray, 0, kInfinity).hit, b = reference.trace(ray, 0, kInfinity).hit;
        if (a.has_value() != b.has_value() || (a && std::abs(a->t - b->t) > 2e-3f)) {
          ++different;  // grazing rays and outlines, where the triangulation itself is off
          continue;
        }
        if (!a) continue;
        ++hits;
        CHECK(dot(a->ng, b->ng) > 0.98f);
        CHECK(length(a->p - to_world.point(point(a->uv.x, a->uv.y))) < 1e-5f * (1 + length(a->p)));
        CHECK(length(a->p - ray.at(a->t)) < 1e-5f * (1 + length(ray.o)));
        CHECK(std::abs(dot(normalize(a->dpdu), a->ng)) < 1e-4f);
      }
      CHECK(hits > 200);
      CHECK(different < 12);
    }
  }
}

TEST_CASE("a patch's normals bend and turn the surface, its uvs the tangent") {
  Scene scene = empty_scene();
  BilinearMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};
  mesh.indices = {0, 1, 2, 3};
  mesh.uvs = {{0, 0}, {4, 0}, {0, 1}, {4, 1}};
  mesh.normals.assign(4, {0.6f, 0, -0.8f});
  scene.shapes.push_back(make_shape(mesh));
  const SurfaceHit hit = *Geometry(scene, nullptr, 1).trace({{0.5f, 0, 2}, {0, 0, -1}}, 0, kInfinity).hit;
  CHECK(hit.uv.x == doctest::Approx(3));
  CHECK(hit.uv.y == doctest::Approx(0.5));
  CHECK(hit.ng.z == doctest::Approx(-1));
  CHECK(hit.ns.x == doctest::Approx(0.6));
  CHECK(std::abs(dot(hit.dpdu, hit.ns)) < 1e-5f);
  CHECK(length(hit.dpdu) == doctest::Approx(0.5).epsilon(0.3));
}

TEST_CASE("instances equal the same shapes placed one by one") {
  Rng rng(4);
  Scene flat = empty_scene(), instanced = empty_scene();
  Object object{"thing", {}};
  object.shapes.push_back(make_shape(box_mesh(), Transform::translate(0.5, 0, 0) * Transform::scale(0.5, 1, 0.3)));
  object.shapes.push_back(make_shape(Sphere{0.8f, -0.8f, 0.3f, 300}, Transform::rotate(30, 1, 0, 0)));
  object.shapes.push_back(make_shape(box_mesh(), Transform::scale(1.2, 1.2, 1.2), kInterface));
  instanced.objects.push_back(object);
  instanced.shapes.push_back(make_shape(Disk{-2, 20, 0, 360}));
  flat.shapes.push_back(instanced.shapes[0]);
  const std::vector<Transform> places{
      Transform::translate(2, 1, 0),
      Transform::translate(-3, 0, 1) * Transform::rotate(50, 1, 1, 0) * Transform::scale(1.5, 0.5, 1)};
  for (const Transform& place : places) {
    instanced.instances.push_back({0, place});
    for (Shape shape : object.shapes) {
      shape.to_world = place * shape.to_world;
      flat.shapes.push_back(shape);
    }
  }
  const Geometry a(flat, nullptr, 1), b(instanced, nullptr, 2);
  CHECK(b.placed().size() == 7);
  CHECK(b.placed()[4].instance == 1);
  CHECK(a.groups().size() == 1);
  CHECK(b.groups().size() == 2);  // one for each instance
  CHECK(length(a.bounds().min - b.bounds().min) < 1.5f);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray = random_ray(rng, 4);
    const Trace x = a.trace(ray, 0, kInfinity), y = b.trace(ray, 0, kInfinity);
    REQUIRE(x.hit.has_value() == y.hit.has_value());
    CHECK(x.crossings.size() == y.crossings.size());
    CHECK(a.trace_shadow(ray, 0, 8).has_value() == b.trace_shadow(ray, 0, 8).has_value());
    if (!x.hit) continue;
    ++hits;
    CHECK(x.hit->shape == y.hit->shape);
    CHECK(x.hit->t == doctest::Approx(y.hit->t).epsilon(1e-4));
    CHECK(dot(x.hit->ng, y.hit->ng) > 0.999f);
    CHECK(length(x.hit->p - y.hit->p) < 1e-4f);
  }
  CHECK(hits > 5000);
}

TEST_CASE("boundaries placed many times are bounded by their boxes: all of each, and quickly") {
  Scene scene = empty_scene();
  const TriangleMesh ball = bumpy_ball(100);
  scene.objects.push_back({"ball", {make_shape(ball, Transform::translate(0, 0.5, 0), kInterface)}});
  Rng rng(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 at = random_point(rng, 50);
    scene.instances.push_back({0, Transform::translate(at.x, at.y, at.z) * Transform::rotate(17 * i, 1, 2, 3)});
  }
  const auto start = std::clock();
  const Geometry geometry(scene, nullptr, 1);
  CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 1.5);  // 80 million triangles cannot be looked at

  REQUIRE(geometry.groups().size() == scene.instances.size());
  for (std::size_t i = 0; i < 20; ++i) {
    Bounds3 exact;
    for (const Vec3 p : ball.positions) exact.expand(scene.instances[i].to_world.point(p + Vec3{0, 0.5f, 0}));
    const Bounds3& bounds = geometry.groups()[i].bounds;
    const Vec3 below = exact.min - bounds.min, above = bounds.max - exact.max;
    CHECK(std::min({below.x, below.y, below.z, above.x, above.y, above.z}) > -1e-4f);
    CHECK(std::max({below.x, below.y, below.z, above.x, above.y, above.z}) < 1.5f);
  }
}

TEST_CASE("a mirrored instance keeps the outside of its shapes outside") {
  Scene scene = empty_scene();
  scene.objects.push_back({"ball", {make_shape(Sphere{}), make_shape(box_mesh(), Transform::translate(4, 0, 0))}});
  scene.instances.push_back({0, Transform::scale(-1, 1.5, 0.5)});
  const Geometry geometry(scene, nullptr, 1);
  CHECK(geometry.trace({{0, 0, 5}, {0, 0, -1}}, 0, kInfinity).hit->ng.z == doctest::Approx(1));
  CHECK(geometry.trace({{-4, 0, 5}, {0, 0, -1}}, 0, kInfinity).hit->ng.z == doctest::Approx(1));
}

TEST_CASE("alpha lets its share of rays through, always the same ones, on every kind of shape") {
  Scene scene = empty_scene();
  scene.textures.push_back({ConstantTexture{Rgb(0.3f)}, {}});
  scene.textures.push_back({ConstantTexture{Rgb(0)}, {}});
  const Textures textures = build_textures(scene.textures);
  for (const Shape& shape : {make_shape(square_mesh()), make_shape(Disk{0, 2, 0, 360})}) {
    scene.shapes = {shape};
    scene.shapes[0].alpha = 1;
    scene.shapes[0].boundary = 0;
    for (const bool boundary : {false, true}) {
      if (!boundary) scene.shapes[0].boundary.reset();
      const Geometry geometry(scene, &textures, 1);
      Rng rng(5);
      int stopped = 0;
      constexpr int kRays = 20000;
      for (int i = 0; i < kRays; ++i) {
        const Ray ray{{between(rng, -1, 1), between(rng, -1, 1), 1}, {0, 0, -1}};
        const Trace trace = geometry.trace(ray, 0, kInfinity);
        stopped += trace.hit.has_value();
        const auto shadow = geometry.trace_shadow(ray, 0, kInfinity);
        CHECK(shadow.has_value() != trace.hit.has_value());
        if (shadow && scene.shapes[0].boundary) CHECK(shadow->size() == 1);  // through the hole is into the medium
      }
      CHECK(stopped == doctest::Approx(0.3 * kRays).epsilon(0.04));
      if (!boundary) {
        scene.shapes[0].alpha = 2;
        CHECK(!Geometry(scene, &textures, 1).trace({{0.1f, 0.2f, 1}, {0, 0, -1}}, 0, kInfinity).hit);
      }
      scene.shapes[0].alpha = 1;
    }
  }
}

// Of both kinds of shapes, in an object that is turned: a quarter turn about x makes the normal z of it the world's y.
TEST_CASE("alpha may depend on the normal") {
  Scene scene = empty_scene();
  scene.textures = {{ConstantTexture{Rgb(1)}, {}}, {ConstantTexture{Rgb(0)}, {}}, {DirectionMixTexture{0, 1, {0, 0, 1}}, {}}};
  const Textures textures = build_textures(scene.textures);
  for (const Shape& shape : {make_shape(square_mesh()), make_shape(Disk{0, 2, 0, 360})}) {
    scene.shapes = {shape};
    scene.shapes[0].alpha = 2;
    scene.objects.clear();
    scene.instances.clear();
    CHECK(Geometry(scene, &textures, 1).trace({{0.1f, 0.2f, 1}, {0, 0, -1}}, 0, kInfinity).hit);
    scene.objects.push_back({"turned", scene.shapes});
    scene.shapes.clear();
    scene.instances.push_back({0, Transform::rotate(90, 1, 0, 0)});
    const Ray down{{0.1f, 1, 0.2f}, {0, -1, 0}};
    CHECK_FALSE(Geometry(scene, &textures, 1).trace(down, 0, kInfinity).hit);
    scene.objects[0].shapes[0].alpha.reset();
    CHECK(Geometry(scene, &textures, 1).trace(down, 0, kInfinity).hit);
  }
}

TEST_CASE("broken shapes are refused at their place") {
  const auto message_of = [](const Shape& shape) -> std::string {
    Scene scene = empty_scene();
    scene.shapes.push_back(shape);
    try {
      Geometry(scene, nullptr, 1);
    } catch (const Error& e) {
      CHECK(e.failure() == Failure::scene);
      return e.what();
    }
    return "";
  };
  TriangleMesh mesh = box_mesh();
  mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  CHECK(message_of(make_shape(mesh)).find("test.pbrt:7:1: vertex 3 is not finite") == 0);
  mesh = box_mesh();
  mesh.indices[5] = 8;
  CHECK(message_of(make_shape(mesh)).find("index 8 is out of range") != std::string::npos);
  mesh = box_mesh();
  mesh.indices.pop_back();
  CHECK(message_of(make_shape(mesh)).find("multiple of 3") != std::string::npos);
  mesh = box_mesh();
  mesh.normals.resize(2);
  CHECK(message_of(make_shape(mesh)).find("2 normals") != std::string::npos);
  CHECK(message_of(make_shape(Sphere{kInfinity, -1, 1, 360})).find("radius") != std::string::npos);
  Shape shape = make_shape(Sphere{});
  shape.material = 9;
  CHECK(message_of(shape).find("material") != std::string::npos);
}

TEST_CASE("empty scenes, empty meshes and degenerate triangles are harmless") {
  const unsigned mode = _mm_getcsr();
  Scene scene = empty_scene();
  const Ray ray{{0, 0, 5}, {0, 0, -1}};
  const Geometry nothing(scene, nullptr, 1);
  CHECK(!nothing.trace(ray, 0, kInfinity).hit);
  CHECK(nothing.trace_shadow(ray, 0, kInfinity)->empty());
  CHECK(nothing.bounds().empty());
  TriangleMesh mesh;
  scene.shapes.push_back(make_shape(mesh));
  mesh.positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  mesh.indices = {0, 1, 2, 0, 0, 0};
  scene.shapes.push_back(make_shape(mesh));
  scene.shapes.push_back(make_shape(mesh, {}, kInterface));
  Geometry geometry(scene, nullptr, 2);
  Geometry moved = std::move(geometry);
  CHECK(!moved.trace(ray, 0, kInfinity).hit);
  CHECK(moved.trace_all(ray, 0, kInfinity).empty());
  CHECK(moved.memory_bytes() > 0);
  CHECK(_mm_getcsr() == mode);
}
