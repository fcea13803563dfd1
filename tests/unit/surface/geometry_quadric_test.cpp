#include <doctest/doctest.h>

#include <functional>

#include "geometry_scenes.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// A quadric by its implicit function and its cut, in object space.
struct Implicit {
  std::function<double(Vec3d)> f;
  std::function<bool(Vec3d)> keeps;
};

double degrees_around(Vec3d p) {
  const double d = std::atan2(p.y, p.x) * 180 / 3.14159265358979;
  return d < 0 ? d + 360 : d;
}

Vec3d at(const Ray& ray, double t) { return Vec3d(ray.o) + Vec3d(ray.d) * t; }

/// Nearest zero along the ray by scanning, in object space; nothing when some zero is too near a cut or a tangent to call.
struct Scan {
  std::optional<double> t;
  bool sure = true;
};
Scan scan(const Implicit& shape, const Ray& object_ray, double t_max) {
  constexpr int kSteps = 3000;
  Scan result;
  double previous = shape.f(at(object_ray, 0));
  for (int i = 1; i <= kSteps; ++i) {
    double low = t_max * (i - 1) / kSteps, high = t_max * i / kSteps;
    const double value = shape.f(at(object_ray, high));
    if (std::abs(value) < 1e-4) result.sure = result.sure && result.t.has_value();
    if ((value > 0) != (previous > 0) && !result.t) {
      for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (low + high);
        ((shape.f(at(object_ray, middle)) > 0) == (previous > 0) ? low : high) = middle;
      }
      const Vec3d p = at(object_ray, low);
      const bool kept = shape.keeps(p);
      for (const Vec3d nudge : {Vec3d(1e-4, 0, 0), Vec3d(-1e-4, 0, 0), Vec3d(0, 1e-4, 0), Vec3d(0, -1e-4, 0), Vec3d(0, 0, 1e-4),
                                Vec3d(0, 0, -1e-4)}) {
        if (shape.keeps(p + nudge) != kept) result.sure = false;
      }
      if (kept) result.t = low;
    }
    previous = value;
  }
  return result;
}

void check_quadric(const Shape& prototype, const Implicit& implicit) {
  Rng rng(1);
  int hits = 0, compared = 0;
  for (const Transform& to_world : trial_transforms()) {
    for (const bool reverse : {false, true}) {
      Scene scene = empty_scene();
      Shape shape = prototype;
      shape.to_world = to_world;
      shape.reverse_orientation = reverse;
      scene.shapes.push_back(shape);
      const Geometry geometry(scene, nullptr, 1);
      const float outside = reverse != to_world.swaps_handedness() ? -1.f : 1.f;
      for (int i = 0; i < 300; ++i) {
        const Ray local = random_ray(rng, 1);
        const Ray ray{to_world.point(local.o), to_world.vector(local.d)};
        const Scan expected = scan(implicit, {to_world.inverse().point(ray.o), to_world.inverse().vector(ray.d)}, 12);
        if (!expected.sure) continue;
        ++compared;
        const auto hit = geometry.trace(ray, 0, kInfinity).hit;
        REQUIRE(hit.has_value() == expected.t.has_value());
        if (!hit) continue;
        ++hits;
        CHECK(hit->t == doctest::Approx(*expected.t).epsilon(1e-4));
        CHECK(length(hit->p - ray.at(hit->t)) < 2e-5f * (1 + length(ray.o)));
        const Vec3d p(to_world.inverse().point(hit->p));
        const double h = 1e-5;
        const Vec3 gradient = to_vec3(Vec3d(implicit.f(p + Vec3d(h, 0, 0)) - implicit.f(p - Vec3d(h, 0, 0)),
                                            implicit.f(p + Vec3d(0, h, 0)) - implicit.f(p - Vec3d(0, h, 0)),
                                            implicit.f(p + Vec3d(0, 0, h)) - implicit.f(p - Vec3d(0, 0, h))) *
                                      (1 / h));
        CHECK(dot(normalize(to_world.normal(gradient)), hit->ng) * outside > 0.9999f);
        CHECK(hit->ns == hit->ng);
        CHECK(std::abs(dot(normalize(hit->dpdu), hit->ng)) < 1e-5f);
        CHECK(hit->uv.x >= 0);
        CHECK(hit->uv.x <= 1.0001f);
        CHECK(hit->uv.y >= -1e-4f);
        CHECK(hit->uv.y <= 1.0001f);
      }
    }
  }
  CHECK(hits > 200);
  CHECK(compared > 2500);
}

}  // namespace

TEST_CASE("a sphere, whole and cut, is where its equation says") {
  const auto f = [](Vec3d p) { return p.x * p.x + p.y * p.y + p.z * p.z - 1; };
  check_quadric(make_shape(Sphere{}), {f, [](Vec3d) { return true; }});
  check_quadric(make_shape(Sphere{1, -0.4f, 0.7f, 230}),
                {f, [](Vec3d p) { return p.z >= -0.4 && p.z <= 0.7 && degrees_around(p) <= 230; }});
}

TEST_CASE("a cylinder, whole and cut, is where its equation says") {
  const auto f = [](Vec3d p) { return p.x * p.x + p.y * p.y - 0.64; };
  check_quadric(make_shape(Cylinder{0.8f, -0.5f, 1, 360}), {f, [](Vec3d p) { return p.z >= -0.5 && p.z <= 1; }});
  check_quadric(make_shape(Cylinder{0.8f, 1, -0.5f, 140}),
                {f, [](Vec3d p) { return p.z >= -0.5 && p.z <= 1 && degrees_around(p) <= 140; }});
}

TEST_CASE("a disk, whole and cut, is where its equation says") {
  const auto f = [](Vec3d p) { return p.z - 0.25; };
  check_quadric(make_shape(Disk{0.25f, 1, 0, 360}), {f, [](Vec3d p) { return p.x * p.x + p.y * p.y <= 1; }});
  check_quadric(make_shape(Disk{0.25f, 1, 0.5f, 200}), {f, [](Vec3d p) {
                                                          const double r2 = p.x * p.x + p.y * p.y;
                                                          return r2 <= 1 && r2 >= 0.25 && degrees_around(p) <= 200;
                                                        }});
}

TEST_CASE("quadrics carry pbrt's texture coordinates and tangents") {
  const auto hit_of = [](Shape shape, const Ray& ray) {
    Scene scene = empty_scene();
    scene.shapes.push_back(std::move(shape));
    return *Geometry(scene, nullptr, 1).trace(ray, 0, kInfinity).hit;
  };
  const SurfaceHit sphere = hit_of(make_shape(Sphere{}), {{0, 3, 0}, {0, -1, 0}});
  CHECK(sphere.uv.x == doctest::Approx(0.25));
  CHECK(sphere.uv.y == doctest::Approx(0.5));
  CHECK(sphere.dpdu.x == doctest::Approx(-2 * kPi));
  CHECK(hit_of(make_shape(Sphere{}), {{0.01f, 0, 3}, {0, 0, -1}}).uv.y == doctest::Approx(1).epsilon(0.01));
  const SurfaceHit disk = hit_of(make_shape(Disk{0, 2, 1, 180}), {{0, 1.25f, 3}, {0, 0, -1}});
  CHECK(disk.uv.x == doctest::Approx(0.5));
  CHECK(disk.uv.y == doctest::Approx(0.75));
  CHECK(disk.ng.z == doctest::Approx(1));
  const SurfaceHit cylinder = hit_of(make_shape(Cylinder{1, 0, 4, 360}), {{-3, 0, 1}, {1, 0, 0}});
  CHECK(cylinder.uv.x == doctest::Approx(0.5));
  CHECK(cylinder.uv.y == doctest::Approx(0.25));
  CHECK(is_finite(hit_of(make_shape(Sphere{}), {{0, 0, 3}, {0, 0, -1}}).dpdu));
}
