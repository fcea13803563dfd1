#include <doctest/doctest.h>

#include "geometry_scenes.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// A ray that passes exactly through what is hard: a vertex, an edge's midpoint, or along an axis in a face's plane.
Ray hard_ray(Rng& rng, float size, Vec3 center) {
  const auto grid = [&] { return static_cast<float>(static_cast<int>(rng.uniform() * 5) - 2) * 0.5f * size; };
  const Vec3 target = center + Vec3{grid(), grid(), grid()};
  Vec3 d{};
  while (d == Vec3{}) d = {grid(), grid(), grid()};
  d = d * (1 / size);  // components 0, 1/2 or 1: the origin below is exact for moderate centres
  return {target - d * (8 * size), d};
}

Ray parity_ray(Rng& rng, float size, Vec3 center) {
  return rng.uniform() < 0.3f ? hard_ray(rng, size, center) : random_ray(rng, 1.5f * size, center);
}

struct Parity {
  int errors = 0;
  int crossings = 0;
  int disorder = 0;
};

/// From outside to outside, every group must be left as often as it was entered, and entered first.
Parity count_parity(const Scene& scene, float size, Vec3 center, int rays) {
  const Geometry geometry(scene, nullptr, 1);
  Parity parity;
  Rng rng(11);
  for (int i = 0; i < rays; ++i) {
    const Ray ray = parity_ray(rng, size, center);
    const Crossings crossings = geometry.trace_all(ray, 0, kInfinity);
    std::vector<int> inside(geometry.groups().size(), 0);
    float last = 0;
    bool disorder = false;
    for (const Crossing& c : crossings) {
      disorder = disorder || c.t < last || (inside[c.group] += c.sign) < 0;
      last = c.t;
    }
    parity.crossings += static_cast<int>(crossings.size());
    parity.errors += std::any_of(inside.begin(), inside.end(), [](int n) { return n != 0; });
    parity.disorder += disorder;
  }
  return parity;
}

void check_parity(const Scene& scene, float size, Vec3 center, int rays) {
  const Parity parity = count_parity(scene, size, center, rays);
  CHECK(parity.errors == 0);
  CHECK(parity.disorder == 0);
  CHECK(parity.crossings > rays / 4);
}

}  // namespace

TEST_CASE("rays leave closed boundaries as often as they enter them, at any offset") {
  for (const double offset : {0.0, 1e3, 1e6}) {
    CAPTURE(offset);
    const double size = offset == 1e6 ? 64 : 1;  // floats are 1/16 apart at 1e6
    const Transform place = Transform::translate(offset, offset, -offset) * Transform::scale(size, size, size);
    const Vec3 center = place.point({0, 0, 0});
    const auto check = [&](auto kind, const Transform& t) {
      Scene scene = empty_scene();
      scene.shapes.push_back(make_shape(std::move(kind), place * t, kInterface));
      check_parity(scene, static_cast<float>(size), center, 60000);
    };
    check(box_mesh(), {});
    check(box_mesh(), Transform::rotate(30, 1, 2, 3));
    check(box_patches(), {});
    check(Sphere{}, {});
    check(Sphere{}, Transform::scale(1, 0.4, 0.8));
    check(bumpy_ball(16), {});
  }
}

TEST_CASE("a box of six quads, nested boxes and a box in an instance are closed too") {
  const auto faces_of = [](const auto& box, std::size_t corners, const Transform& t, Scene& scene) {
    for (std::size_t i = 0; i < box.indices.size(); i += corners) {
      auto face = box;
      face.indices.assign(box.indices.begin() + static_cast<std::ptrdiff_t>(i),
                          box.indices.begin() + static_cast<std::ptrdiff_t>(i + corners));
      scene.shapes.push_back(make_shape(face, t, kInterface));
    }
  };
  const Transform turned = Transform::rotate(25, 3, 1, 2);
  for (const Transform& t : {Transform(), turned}) {
    Scene patches = empty_scene();
    faces_of(box_patches(), 4, t, patches);
    check_parity(patches, 1, {}, 60000);
    Scene quads = empty_scene();
    faces_of(box_mesh(), 6, t, quads);
    check_parity(quads, 1, {}, 60000);
    Scene mixed = empty_scene();  // three faces of triangles, three patches
    faces_of(box_mesh(), 6, t, mixed);
    faces_of(box_patches(), 4, t, mixed);
    mixed.shapes.erase(mixed.shapes.begin() + 3, mixed.shapes.begin() + 9);
    check_parity(mixed, 1, {}, 60000);
  }
  Scene nested = empty_scene();
  nested.boundaries.push_back({std::nullopt, MediumId{0}});
  nested.shapes.push_back(make_shape(box_mesh(), {}, kInterface));
  nested.shapes.push_back(make_shape(box_mesh(), Transform::scale(0.5, 0.5, 0.5), kInterface));
  nested.shapes.push_back(make_shape(Sphere{0.4f, -0.4f, 0.4f, 360}, {}, kInterface));
  nested.shapes[2].boundary = 1;
  check_parity(nested, 1, {}, 60000);
  Scene instanced = empty_scene();
  instanced.objects.push_back({"box", {make_shape(box_mesh(), turned, kInterface)}});
  instanced.instances.push_back({0, Transform::translate(5000, 0, 0) * Transform::rotate(77, 1, 1, 1)});
  instanced.instances.push_back({0, Transform::translate(5000, 0.5, 0) * Transform::scale(-1, 1, 1)});
  check_parity(instanced, 1, {5000, 0, 0}, 60000);
}

TEST_CASE("a random million: no leak through a bumpy ball") {
  Scene scene = empty_scene();
  scene.shapes.push_back(make_shape(bumpy_ball(24), Transform::rotate(10, 1, 1, 0), kInterface));
  const Parity parity = count_parity(scene, 1, {}, 1000000);
  CHECK(parity.errors == 0);
  CHECK(parity.disorder == 0);
}

TEST_CASE("rays exactly through vertices, edges and faces cross a box once in and once out, or not at all") {
  Scene scene = empty_scene();
  scene.shapes.push_back(make_shape(box_mesh(), {}, kInterface));
  const Geometry geometry(scene, nullptr, 1);
  CHECK(geometry.trace_all({{-3, -3, -3}, {1, 1, 1}}, 0, kInfinity).size() == 2);                // corner to corner
  CHECK(geometry.trace_all({{-3, -3, 0}, {1, 1, 0}}, 0, kInfinity).size() == 2);                 // edge to edge
  CHECK(geometry.trace_all({{-3, 0, 0}, {1, 0, 0}}, 0, kInfinity).size() == 2);                  // the faces' diagonals
  for (const Vec3 o : {Vec3{-3, 1, 0}, Vec3{-3, 1, 1}, Vec3{-3, -1, 0.5f}, Vec3{-3, -1, -1}}) {  // in a face, along an edge
    CHECK(sum_of(geometry.trace_all({o, {1, 0, 0}}, 0, kInfinity)) == 0);
  }
}

TEST_CASE("a point's groups are found from any direction") {
  Rng rng(12);
  Scene scene = empty_scene();
  scene.shapes.push_back(make_shape(box_mesh(), {}, kInterface));
  scene.shapes.push_back(make_shape(Sphere{}, Transform::translate(1, 0, 0)));  // real, a group of its own
  scene.boundaries.push_back({MediumId{0}, std::nullopt});
  scene.shapes[1].boundary = 1;
  const Geometry geometry(scene, nullptr, 1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = random_point(rng, 2.5f);
    std::array<int, 2> sum{};
    for (const Crossing& c : geometry.trace_all({p, random_direction(rng)}, 0, kInfinity)) sum[c.group] += c.sign;
    CHECK(-sum[0] == (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1 ? 1 : 0));
    if (std::abs(length(p - Vec3{1, 0, 0}) - 1) > 1e-5f) CHECK(-sum[1] == (length(p - Vec3{1, 0, 0}) < 1 ? 1 : 0));
  }
}

TEST_CASE("duplicates count once, thin shells twice") {
  const Ray ray{{0.3f, 0.2f, 5}, {0.01f, 0.02f, -1}};
  Scene twice = empty_scene();
  twice.shapes.assign(2, make_shape(box_mesh(), {}, kInterface));
  CHECK(Geometry(twice, nullptr, 1).trace_all(ray, 0, kInfinity).size() == 2);
  Scene shell = empty_scene();
  shell.shapes.push_back(make_shape(Sphere{}, {}, kInterface));
  shell.shapes.push_back(make_shape(Sphere{}, Transform::scale(0.9999, 0.9999, 0.9999), kInterface));
  const Crossings crossings = Geometry(shell, nullptr, 1).trace_all(ray, 0, kInfinity);
  REQUIRE(crossings.size() == 4);
  CHECK(crossings[1].sign == 1);
  CHECK(crossings[1].t > crossings[0].t);
  Scene stack = empty_scene();  // two boxes that share a face: out of one is into the next, nothing happens
  stack.shapes.push_back(make_shape(box_mesh(), {}, kInterface));
  stack.shapes.push_back(make_shape(box_mesh(), Transform::translate(0, 0, 2), kInterface));
  CHECK(Geometry(stack, nullptr, 1).trace_all(ray, 0, kInfinity).size() == 2);
}

TEST_CASE("trace, trace_shadow and trace_all tell one story") {
  Rng rng(13);
  Scene scene = empty_scene();
  scene.shapes.push_back(make_shape(box_mesh(), Transform::rotate(20, 1, 0, 1) * Transform::scale(2, 2, 2), kInterface));
  scene.shapes.push_back(make_shape(bumpy_ball(10), Transform::translate(0.5, 0, 0)));
  scene.shapes.push_back(make_shape(Sphere{0.5f, -0.5f, 0.5f, 360}, Transform::translate(-1.5, 0, 0), kInterface));
  Shape invisible = make_shape(Sphere{}, Transform::translate(0, 0, 1), kInterface);
  invisible.boundary.reset();
  scene.shapes.push_back(invisible);
  const Geometry geometry(scene, nullptr, 1);
  int blocked = 0;
  for (int i = 0; i < 30000; ++i) {
    const Ray ray = random_ray(rng, 2);
    const float t_max = between(rng, 1, 12);
    const Trace trace = geometry.trace(ray, 0, t_max);
    const auto shadow = geometry.trace_shadow(ray, 0, t_max);
    CHECK(shadow.has_value() != trace.hit.has_value());
    CHECK(geometry.occluded(ray, 0, t_max) == trace.hit.has_value());
    if (trace.hit) CHECK(trace.hit->shape == 1u);
    const Crossings all = geometry.trace_all(ray, 0, t_max);
    blocked += trace.hit.has_value();
    const Crossings& seen = shadow ? *shadow : trace.crossings;
    CHECK(seen.size() <= all.size());
    if (shadow) CHECK(seen.size() == all.size());
    for (std::size_t k = 0; k < seen.size(); ++k) {
      CHECK(seen[k].t == all[k].t);
      CHECK(seen[k].sign == all[k].sign);
    }
  }
  CHECK(blocked > 1000);
}

TEST_CASE("a segment through media ends at a boundary that is too near to the surface behind") {
  Scene scene = empty_scene();
  scene.shapes.push_back(make_shape(box_mesh(), {}, kInterface));
  TriangleMesh floor;  // so large that its place is known to 2e-3 only
  floor.positions = {{-5000, -1.001f, -5000}, {5000, -1.001f, -5000}, {5000, -1.001f, 5000}, {-5000, -1.001f, 5000}};
  floor.indices = {0, 2, 1, 0, 3, 2};
  scene.shapes.push_back(make_shape(floor));
  const Trace trace = Geometry(scene, nullptr, 1).trace({{0.1f, 0.2f, 0.3f}, {0, -1, 0}}, 0, kInfinity);
  REQUIRE(trace.hit);
  REQUIRE(trace.hit->position_error > 1e-3f);
  CHECK(trace.crossings.empty());
  CHECK(trace.t_end == doctest::Approx(1.2).epsilon(1e-6));
  CHECK(trace.hit->t == doctest::Approx(1.201).epsilon(1e-5));
}

TEST_CASE("a boundary coplanar with the surface that is hit belongs to the far side") {
  Rng rng(14);
  Scene scene = empty_scene();
  const Transform t = Transform::rotate(35, 1, 2, 0);
  scene.shapes.push_back(make_shape(box_mesh(), t, kInterface));  // fog that stands on a floor
  TriangleMesh floor;
  floor.positions = {{-5, -1, -5}, {5, -1, -5}, {5, -1, 5}, {-5, -1, 5}};
  floor.indices = {0, 2, 1, 0, 3, 2};
  scene.shapes.push_back(make_shape(floor, t));
  const Geometry geometry(scene, nullptr, 1);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 foot = t.point({between(rng, -0.9f, 0.9f), -1, between(rng, -0.9f, 0.9f)});
    const Vec3 inside = t.point(random_point(rng, 0.8f));
    const Ray ray{inside, normalize(foot - inside)};
    const Trace trace = geometry.trace(ray, 0, kInfinity);
    if (!trace.hit) continue;
    ++hits;
    CHECK(trace.crossings.empty());
    CHECK(trace.t_end == doctest::Approx(trace.hit->t).epsilon(1e-5));
    CHECK(trace.t_end <= trace.hit->t);
    const Vec3 up = normalize(inside - foot);
    CHECK(sum_of(geometry.trace_all({geometry.offset_origin(*trace.hit, up), up}, 0, kInfinity)) == -1);
  }
  CHECK(hits == 20000);
}

TEST_CASE("closed boundaries whose normals point inward hold their outside medium; open ones stay as they are") {
  const auto group_of = [](std::vector<Shape> shapes) {
    Scene scene = empty_scene();
    scene.boundaries[0] = {std::nullopt, MediumId{0}};
    scene.shapes = std::move(shapes);
    const Geometry geometry(scene, nullptr, 1);
    int inside = 0;  // of the origin
    for (const Crossing& c : geometry.trace_all({{0.1f, 0.2f, 0.3f}, {0.1f, 0.2f, 1}}, 0, kInfinity)) inside -= c.sign;
    const BoundaryGroup& group = geometry.groups().at(0);
    return std::pair(group, inside);
  };
  const auto reversed = [](Shape shape) {
    shape.reverse_orientation = true;
    return shape;
  };
  const Transform mirror = Transform::translate(0.1, 0, 0) * Transform::rotate(20, 1, 2, 3) * Transform::scale(-2, 2, 3);
  const std::vector<Shape> inward{
      reversed(make_shape(Sphere{2, -2, 2}, {}, kInterface)), reversed(make_shape(box_mesh(), {}, kInterface)),
      reversed(make_shape(box_patches(), {}, kInterface)), make_shape(Sphere{}, mirror, kInterface)};
  for (const Shape& shape : inward) {
    const auto [group, inside] = group_of({shape});
    CHECK(group.inverted);
    CHECK(group.inside == MediumId{0});
    CHECK_FALSE(group.outside.has_value());
    CHECK(inside == 1);
  }
  for (const Shape& shape : {make_shape(Sphere{}, {}, kInterface), make_shape(box_mesh(), mirror, kInterface)})
    CHECK_FALSE(group_of({shape}).first.inverted);

  Shape top = make_shape(Disk{1}, {}, kInterface), bottom = reversed(make_shape(Disk{-1}, {}, kInterface));
  Shape side = make_shape(Cylinder{}, {}, kInterface);
  CHECK_FALSE(group_of({side, top, bottom}).first.inverted);
  for (Shape* shape : {&top, &bottom, &side}) shape->reverse_orientation = !shape->reverse_orientation;
  CHECK(group_of({side, top, bottom}).first.inverted);

  // A bowl has volume on both sides of its middle and is no boundary of either.
  CHECK_FALSE(group_of({reversed(make_shape(Sphere{2, -2, 0}, {}, kInterface))}).first.inverted);
}

TEST_CASE("an inward boundary without an outside medium keeps its inside medium within") {
  Scene scene = empty_scene();
  scene.shapes.push_back(make_shape(Sphere{}, Transform::scale(-1, 1, 1), kInterface));
  const Geometry geometry(scene, nullptr, 1);
  CHECK(geometry.groups().at(0).inverted);
  CHECK(geometry.groups().at(0).inside == MediumId{0});
}
