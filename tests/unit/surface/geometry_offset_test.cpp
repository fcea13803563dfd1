#include <doctest/doctest.h>

#include "geometry_scenes.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

struct SelfHits {
  int candidate = 0, met = 0;
  float worst_offset = 0;  // relative to the scene's scale
};

/// Hits of single convex-side surfaces: a ray that leaves on the outside, or through the inside with nothing behind,
/// meets nothing more. `outward` says along which normal side nothing else lies.
SelfHits count_self_hits(const Scene& scene, float size, Vec3 center, int rays) {
  const Geometry geometry(scene, nullptr, 1);
  Rng rng(21);
  SelfHits result;
  while (result.candidate < rays) {
    const Vec3 from = random_direction(rng) * (3 * size);
    const Ray in{center + from, normalize(random_point(rng, 0.6f * size) - from)};
    const auto hit = geometry.trace(in, 0, kInfinity).hit;
    if (!hit) {
      ++result.candidate;
      continue;
    }
    for (int k = 0; k < 4; ++k) {
      Vec3 d = random_direction(rng);
      if (k == 3) d = normalize(cross(hit->ng, d) + hit->ng * between(rng, 1e-6f, 1e-3f));  // grazing
      if (dot(d, hit->ng) < 0) d = -d;
      const Vec3 origin = geometry.offset_origin(*hit, d);
      ++result.candidate;
      result.met += geometry.trace({origin, d}, 0, kInfinity).hit.has_value();
      result.worst_offset = std::max(result.worst_offset, length(origin - hit->p) / size);
    }
  }
  return result;
}

}  // namespace

TEST_CASE("rays that leave a surface do not meet it again, at any scale and offset") {
  int candidate = 0;
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    for (const double offset : {0.0, 1e3, 1e6}) {
      if (offset * 1e-5 > scale) continue;  // the scene would be a handful of floats wide
      CAPTURE(scale);
      CAPTURE(offset);
      const Transform place = Transform::translate(offset, -offset, offset) * Transform::scale(scale, scale, scale);
      const Vec3 center = place.point({0, 0, 0});
      const Transform turned = place * Transform::rotate(50, 1, 2, 3) * Transform::scale(1, 0.3, 0.6);
      const auto check = [&](const Shape& shape, bool as_instance) {
        Scene scene = empty_scene();
        if (as_instance) {
          scene.objects.push_back({"thing", {shape}});
          scene.objects[0].shapes[0].to_world = Transform();
          scene.instances.push_back({0, turned});
        } else {
          scene.shapes.push_back(shape);
        }
        const SelfHits result = count_self_hits(scene, static_cast<float>(scale), center, 14000);
        CHECK(result.met == 0);
        CHECK(result.worst_offset < 1e-4f + 1e-6f * static_cast<float>(offset / scale));
        candidate += result.candidate;
      };
      for (const bool as_instance : {false, true}) {
        check(make_shape(box_mesh(), turned), as_instance);
        check(make_shape(box_patches(), turned), as_instance);
        check(make_shape(Sphere{}, turned), as_instance);
        check(make_shape(Disk{0.1f, 1, 0, 360}, turned), as_instance);
        Shape boundary = make_shape(box_mesh(), turned);
        boundary.boundary = 0;
        check(boundary, as_instance);
      }
    }
  }
  CHECK(candidate > 1000000);
}

TEST_CASE("position_error bounds the distance from p to the plane of its triangle") {
  Rng rng(23);
  for (const double offset : {0.0, 1e3, 1e6}) {
    const Transform place =
        Transform::translate(offset, -offset, offset) * Transform::rotate(50, 1, 2, 3) * Transform::scale(64, 64, 64);
    Scene scene = empty_scene();
    scene.shapes.push_back(make_shape(box_mesh(), place));
    scene.shapes[0].boundary = 0;
    const Geometry geometry(scene, nullptr, 1);
    const auto& mesh = std::get<TriangleMesh>(scene.shapes[0].kind);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto hit = geometry.trace(random_ray(rng, 64, place.point({0, 0, 0})), 0, kInfinity).hit;
      if (!hit) continue;
      const auto vertex = [&](std::size_t k) {
        return Vec3d(place.point(mesh.positions[mesh.indices[3 * hit->primitive + k]]));
      };
      const Vec3d n = normalize(cross(vertex(1) - vertex(0), vertex(2) - vertex(0)));
      const double distance = std::abs(dot(Vec3d(hit->p) - vertex(0), n));
      CHECK(distance <= hit->position_error);
      worst = std::max(worst, distance / hit->position_error);
    }
    CHECK(worst > (offset == 1e6 ? 0.1 : 0));  // a bound, not a wish
  }
}

TEST_CASE("thin triangles are left cleanly too") {
  Rng rng(22);
  Scene scene = empty_scene();
  TriangleMesh mesh;
  mesh.positions = {{-1, 0, 0.2f}, {1, 0.001f, -0.1f}, {0.3f, 0.0007f, 0.001f}};
  mesh.indices = {0, 1, 2};
  scene.shapes.push_back(make_shape(mesh, Transform::rotate(40, 1, 1, 0)));
  const Geometry geometry(scene, nullptr, 1);
  int candidate = 0, met = 0;
  for (int i = 0; i < 50000; ++i) {
    const float a = rng.uniform(), b = rng.uniform() * (1 - a);
    const Vec3 target =
        scene.shapes[0].to_world.point(mesh.positions[0] * (1 - a - b) + mesh.positions[1] * a + mesh.positions[2] * b);
    const Vec3 o = random_direction(rng) * 3;
    const auto hit = geometry.trace({o, normalize(target - o)}, 0, kInfinity).hit;
    if (!hit) continue;
    const Vec3 d = random_direction(rng);
    ++candidate;
    met += geometry.trace({geometry.offset_origin(*hit, d), d}, 0, kInfinity).hit.has_value();
  }
  CHECK(candidate > 5000);
  CHECK(met == 0);
}
