#include "transport/camera/camera_ray.h"

#include <doctest/doctest.h>

using namespace tyndall;

namespace {

Film film(int width, int height) {
  Film f;
  f.width = width;
  f.height = height;
  return f;
}

}  // namespace

TEST_CASE("field of view spans the shorter side, y runs downward") {
  Camera camera;
  camera.fov_degrees = 90;
  const CameraRays wide(camera, film(200, 100));
  CHECK(wide.ray({100, 50}, {0.5f, 0.5f}).d.z == doctest::Approx(1));
  const Vec3 top = wide.ray({100, 0}, {0.5f, 0.5f}).d;
  CHECK(top.y / top.z == doctest::Approx(1));
  const Vec3 right = wide.ray({200, 50}, {0.5f, 0.5f}).d;
  CHECK(right.x / right.z == doctest::Approx(2));
  const CameraRays tall(camera, film(100, 200));
  const Vec3 left = tall.ray({0, 100}, {0.5f, 0.5f}).d;
  CHECK(left.x / left.z == doctest::Approx(-1));
}

TEST_CASE("an orthographic camera has parallel rays from the screen") {
  Camera camera;
  camera.kind = Camera::Kind::orthographic;
  camera.screen_window = {{-2, 2, -1, 1}};
  camera.to_world = Transform::translate(0, 0, 5);
  const CameraRays rays(camera, film(4, 2));
  const Ray ray = rays.ray({4, 0}, {0, 0});
  CHECK(ray.o.x == doctest::Approx(2));
  CHECK(ray.o.y == doctest::Approx(1));
  CHECK(ray.o.z == doctest::Approx(5));
  CHECK(ray.d.z == doctest::Approx(1));
  CHECK_FALSE(rays.is_pinhole());
}

TEST_CASE("rays through any point of the lens meet in the plane of focus") {
  Camera camera;
  camera.lens_radius = 0.3f;
  camera.focal_distance = 4;
  const CameraRays rays(camera, film(10, 10));
  const Ray a = rays.ray({3, 7}, {0.1f, 0.2f}), b = rays.ray({3, 7}, {0.9f, 0.6f});
  CHECK(length(a.o - b.o) > 0.05f);
  CHECK(length(a.at(4 / a.d.z) + Vec3{0, 0, -a.o.z} - b.at(4 / b.d.z)) < 1e-5f);
}

namespace {

CameraRays spherical(Camera::Kind kind, const Transform& to_world = {}) {
  Camera camera;
  camera.kind = kind;
  camera.to_world = to_world;
  camera.lens_radius = 0.5f;  // of no effect
  return {camera, film(64, 32)};
}

bool close(Vec3 a, Vec3 b) { return length(a - b) < 1e-6f; }

}  // namespace

TEST_CASE("an equirectangular camera sees +y on top and turns from +x over +z") {
  const CameraRays rays = spherical(Camera::Kind::spherical_equirectangular);
  const auto direction = [&](float x, float y) { return rays.ray({x, y}, {0.1f, 0.9f}).d; };
  CHECK(close(direction(7, 0), {0, 1, 0}));
  CHECK(close(direction(7, 32), {0, -1, 0}));
  CHECK(close(direction(0, 16), {1, 0, 0}));
  CHECK(close(direction(16, 16), {0, 0, 1}));
  CHECK(close(direction(32, 16), {-1, 0, 0}));
  CHECK(close(direction(48, 8), {0, std::sqrt(0.5f), -std::sqrt(0.5f)}));
  CHECK(close(direction(8, -2), direction(40, 2)));  // filters reach over the pole
}

TEST_CASE("an equal-area camera sees +y in the middle, and pixels of one solid angle all around") {
  const CameraRays rays = spherical(Camera::Kind::spherical_equal_area);
  const auto direction = [&](float x, float y) { return rays.ray({x, y}, {0.1f, 0.9f}).d; };
  CHECK(close(direction(32, 16), {0, 1, 0}));
  CHECK(close(direction(64, 16), {1, 0, 0}));
  CHECK(close(direction(32, 32), {0, 0, 1}));
  CHECK(close(direction(0, 0), {0, -1, 0}));
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (y == 15 || y == 16 || x == 31 || x == 32 || x % 63 == 0 || y % 31 == 0) continue;  // folds, and the poles
      const float u = static_cast<float>(x) + 0.5f, v = static_cast<float>(y) + 0.5f, e = 0.05f;
      const double between =
          length(cross(direction(u + e, v) - direction(u - e, v), direction(u, v + e) - direction(u, v - e)));
      REQUIRE(between / (4 * e * e) == doctest::Approx(4 * kPi / (64 * 32)).epsilon(0.02));
    }
  }
  // Filters reach over the edges, on the smallest of films far over.
  const float e = 4;
  for (const float t : {3.0f, 20.0f, 31.5f}) {
    CHECK(length(direction(-e, t) - direction(e, t)) > 0.1f);
    CHECK(length(direction(-e, t) - direction(e, 32 - t)) < 1e-5f);
    CHECK(length(direction(64 + e, t) - direction(64 - e, 32 - t)) < 1e-5f);
    CHECK(length(direction(t, -e) - direction(64 - t, e)) < 1e-5f);
    CHECK(length(direction(t + 128, 64 * 5 + t) - direction(t, t)) < 1e-4f);
  }
}

TEST_CASE("a spherical camera has a center, radial depth, and no place for techniques that need a plane") {
  const Transform to_world = Transform::translate(1, 2, 3) * Transform::rotate(90, 0, 0, 1) * Transform::scale(3, 3, 3);
  for (const Camera::Kind kind : {Camera::Kind::spherical_equal_area, Camera::Kind::spherical_equirectangular}) {
    const CameraRays rays = spherical(kind, to_world);
    CHECK(rays.is_spherical());
    CHECK_FALSE(rays.is_pinhole());
    const Ray ray = rays.ray({50, 11}, {0.1f, 0.9f});
    CHECK(ray.o == Vec3{1, 2, 3});
    CHECK(length(ray.d) == doctest::Approx(1));
    CHECK(rays.depth(ray.at(2.5f)) == doctest::Approx(2.5));
  }
  CHECK(close(spherical(Camera::Kind::spherical_equirectangular, to_world).ray({7, 0}, {}).d, {-1, 0, 0}));
  CHECK_FALSE(CameraRays(Camera{}, film(4, 2)).is_spherical());
}

TEST_CASE("steps of a spherical camera's pixels cover the sphere, each its share") {
  const CameraRays rays = spherical(Camera::Kind::spherical_equal_area, Transform::translate(1, 2, 3));
  for (const Vec3 to_p : {Vec3{0, 0, 5}, Vec3{-3, 4, -12}}) {
    const auto [dx, dy] = rays.pixel_steps(rays.center() + to_p, normalize(to_p));
    const double distance = length(to_p);
    CHECK(length(cross(dx, dy)) == doctest::Approx(4 * kPi * distance * distance / (64 * 32)));
    CHECK(dot(dx, dy) == doctest::Approx(0));
    CHECK(dot(dx, to_p) == doctest::Approx(0));
  }
}

TEST_CASE("worldToNDC takes a point to its place on the film") {
  Camera camera;
  camera.fov_degrees = 50;
  camera.to_world = Transform::look_at({1, 2, -3}, {0, 0.5f, 1}, {0, 1, 0}).inverse();
  const CameraRays rays(camera, film(320, 180));
  const Vec3 p = rays.ray({80, 135}, {0, 0}).at(2.5f);
  const auto m = rays.world_to_ndc();
  const auto row = [&](int r) { return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r]; };
  CHECK(row(0) / row(3) == doctest::Approx(0.25));
  CHECK(row(1) / row(3) == doctest::Approx(0.75));
}

TEST_CASE("a point is seen at the film position whose ray passes it, far from the origin too") {
  Camera camera;
  camera.fov_degrees = 50;
  for (const float far : {0.0f, 1e4f}) {
    camera.to_world = Transform::translate(far, -far, 3) * Transform::rotate(40, 1, 2, 3);
    const CameraRays rays(camera, film(640, 360));
    for (const Vec2 x : {Vec2{0, 0}, Vec2{320.25f, 100.5f}, Vec2{639, 359}, Vec2{-50, 400}}) {
      const Ray ray = rays.ray(x, {0.5f, 0.5f});
      const auto again = rays.film_position(ray.at(20));
      REQUIRE(again);
      // The ray's point is rounded to 2^-24 of 1e4 units: 20 units away that is 0.012 pixels.
      CHECK(again->x == doctest::Approx(x.x).epsilon(1e-6).scale(far > 0 ? 5e4 : 500));
      CHECK(again->y == doctest::Approx(x.y).epsilon(1e-6).scale(far > 0 ? 5e4 : 500));
      CHECK_FALSE(rays.film_position(ray.at(-20)));
    }
  }
}

TEST_CASE("a pixel's step on a plane is where the neighbouring pixel's ray meets it, whatever the camera's unit of length") {
  Camera perspective, parallel;
  perspective.fov_degrees = 50;
  parallel.kind = Camera::Kind::orthographic;
  for (int i = 0; i < 6; ++i) {
    Camera* const camera = i % 2 == 0 ? &perspective : &parallel;
    const float unit = std::array{1.0f, 0.125f, 5.0f}[static_cast<std::size_t>(i / 2)];
    camera->to_world = Transform::translate(1, 2, 3) * Transform::rotate(30, 1, 1, 0) * Transform::scale(unit, unit, unit);
    const CameraRays rays(*camera, film(40, 30));
    const Vec3 n = normalize(Vec3{0.3f, -0.4f, -0.8f});
    const auto on_plane = [&](Vec2 pixel) {
      const Ray ray = rays.ray(pixel, {0.5f, 0.5f});
      return ray.at(dot(n, Vec3{2, 1, 9} - ray.o) / dot(n, ray.d));
    };
    const Vec3 p = on_plane({12.5f, 20.25f});
    const auto [dx, dy] = rays.pixel_steps(p, n);
    CHECK(length(dx - (on_plane({13.5f, 20.25f}) - p)) < 1e-4f * length(dx));
    CHECK(length(dy - (on_plane({12.5f, 21.25f}) - p)) < 1e-4f * length(dy));
  }
  // What lies behind the camera counts as far as its distance says.
  const CameraRays rays(perspective, film(40, 30));
  const Vec3 back = rays.to_world().vector({0, 0, -1}), behind = rays.center() + 5.0f * back;
  const Vec3 ahead = rays.center() - 5.0f * back;
  CHECK(length(rays.pixel_steps(behind, back)[0]) == doctest::Approx(length(rays.pixel_steps(ahead, back)[0])));
}
