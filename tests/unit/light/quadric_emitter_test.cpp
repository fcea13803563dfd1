#include "light/quadric_emitter.h"

#include <doctest/doctest.h>

#include "emitter_check.h"

namespace tyndall {
namespace {

constexpr double kTau = 6.28318530717958647692;

/// The shape's parametrisation, written out once more; its area by differences.
Vec3d object_point(const Shape& shape, double u, double v) {
  if (const auto* s = std::get_if<Sphere>(&shape.kind)) {
    const double low = std::acos(std::clamp<double>(s->z_min / s->radius, -1, 1));
    const double high = std::acos(std::clamp<double>(s->z_max / s->radius, -1, 1));
    const double theta = low + v * (high - low), phi = u * kTau * s->phi_max_degrees / 360;
    return Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)) * s->radius;
  }
  if (const auto* d = std::get_if<Disk>(&shape.kind)) {
    const double r = d->radius + v * (d->inner_radius - d->radius), phi = u * kTau * d->phi_max_degrees / 360;
    return {r * std::cos(phi), r * std::sin(phi), d->height};
  }
  const auto& c = std::get<Cylinder>(shape.kind);
  const double phi = u * kTau * c.phi_max_degrees / 360;
  return {c.radius * std::cos(phi), c.radius * std::sin(phi), c.z_min + v * (c.z_max - c.z_min)};
}

Vec3d mapped(const Transform& t, Vec3d p) {
  const auto& m = t.matrix();
  return {m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3], m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
          m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]};
}

test::EmitterUnderTest quadric(std::string name, const Shape& shape, bool cone) {
  const auto e = std::make_shared<QuadricEmitter>(shape, shape.to_world, true);
  // The parametrisation runs so that its normal is the shape's own; mirrors and reversal turn it.
  const double sign = shape.reverse_orientation ? -1 : 1;
  return {std::move(name), [=](Vec3 p, Vec2 u) { return e->sample(p, u); }, [=](Vec3 p, Vec3 hit) { return e->pdf(p, hit); },
          [=](double u, double v) -> std::optional<test::SurfacePoint> {
            const double h = 1e-5;
            const auto at = [&](double a, double b) { return mapped(shape.to_world, object_point(shape, a, b)); };
            const Vec3d du = (at(u + h, v) - at(u - h, v)) / (2 * h), dv = (at(u, v + h) - at(u, v - h)) / (2 * h);
            return test::SurfacePoint{at(u, v), cross(du, dv) * sign};
          },
          cone};
}

Shape shape_of(std::variant<TriangleMesh, BilinearMesh, Sphere, Disk, Cylinder> kind, const Transform& t = {},
               bool reverse = false) {
  Shape s;
  s.kind = std::move(kind);
  s.to_world = t;
  s.reverse_orientation = reverse;
  return s;
}

const Transform kTurned = Transform::translate(0.1, 0.2, 0.3) * Transform::rotate(50, 1, 2, 3);
const Transform kMirrored = kTurned * Transform::scale(1, 1, -1);
const Transform kStretched = kTurned * Transform::scale(0.4, 1, 2.5);
const Transform kSheared = kStretched * Transform::rotate(30, 0, 1, 0) * Transform::scale(1, 0.7, 1);

TEST_CASE("whole spheres are sampled over the cone they are seen under") {
  const Sphere unit;
  for (const auto& [t, what] :
       {std::pair{Transform(), "plain"}, std::pair{kTurned * Transform::scale(0.5, 0.5, 0.5), "turned"}})
    for (const Vec3 p : {Vec3{0, 0, 3}, Vec3{1.5f, -1.2f, 0.4f}, Vec3{40, 20, 10}, Vec3{1.5f, 0.5f, -0.2f}})
      test::check_emitter(quadric(what, shape_of(unit, t), true), p, normalize(Vec3{0.1f, 0.2f, 0.3f} - p), 8, 60);
}

TEST_CASE("spheres seen from inside, cut, or stretched are sampled by area") {
  const Sphere unit, cut{1, -0.3f, 0.8f, 220};
  test::check_emitter(quadric("inside", shape_of(unit), false), {0.2f, 0.3f, -0.4f}, {0, 0, 1});
  for (const Vec3 p : {Vec3{0, 0, 4}, Vec3{2, -2, 1}, Vec3{-3, 1, -3}}) {
    test::check_emitter(quadric("cut", shape_of(cut), false), p, normalize(-p));
    test::check_emitter(quadric("cut, stretched", shape_of(cut, kStretched), false), p, normalize(-p));
    test::check_emitter(quadric("ellipsoid", shape_of(unit, kStretched), false), p, normalize(-p));
    test::check_emitter(quadric("sheared", shape_of(unit, kSheared), false), p, normalize(-p));
    test::check_emitter(quadric("reversed", shape_of(cut, kTurned, true), false), p, normalize(-p));
  }
}

// Of a point that rounding has put 1e-6 outside of a sphere of radius 3, the near cap has normals within 1e-3 of a right angle.
TEST_CASE("a sphere shows its outside to none of its own points, where rounding has put them") {
  Rng rng(23);
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&] { return 20 * rng.uniform() - 10; };
    const Vec3 at{number(), number(), number()};
    const QuadricEmitter e(shape_of(Sphere{3, -3, 3, 360}), Transform::translate(at.x, at.y, at.z), true);
    const Vec3 p = at + normalize(Vec3{number(), number(), number()}) * 3;
    const auto s = e.sample(p, {rng.uniform(), rng.uniform()});
    if (s) REQUIRE(dot(s->ng, s->wi) > -1e-2f);
  }
}

TEST_CASE("disks and cylinders are sampled by area, under any transform") {
  const Disk disk{0.2f, 1, 0.3f, 300}, whole{};
  const Cylinder cylinder{0.7f, -0.5f, 0.9f, 250};
  for (const Vec3 p : {Vec3{0.2f, 0.1f, 3}, Vec3{2, -2, -2}, Vec3{-50, 10, 30}})
    for (const auto& t : {Transform(), kTurned, kStretched, kSheared}) {
      test::check_emitter(quadric("disk", shape_of(disk, t), false), p, normalize(-p));
      test::check_emitter(quadric("whole disk", shape_of(whole, t), false), p, normalize(-p));
      test::check_emitter(quadric("cylinder", shape_of(cylinder, t), false), p, normalize(-p));
    }
}

TEST_CASE("a mirror turns a quadric's normal as it turns the geometry's: against the outer one") {
  const auto sample = [](const Shape& s) { return QuadricEmitter(s, s.to_world, true).sample(Vec3{5, 5, 5}, {0.3f, 0.6f}); };
  const Sphere unit;
  CHECK(dot(sample(shape_of(unit, kTurned))->ng, {1, 1, 1}) > 0);
  CHECK(dot(sample(shape_of(unit, kMirrored))->ng, {1, 1, 1}) < 0);
  CHECK(dot(sample(shape_of(unit, kMirrored, true))->ng, {1, 1, 1}) > 0);
}

TEST_CASE("areas of quadrics") {
  CHECK(QuadricEmitter(shape_of(Sphere{2, -2, 2, 360}), {}, true).area() == doctest::Approx(16 * kPi));
  CHECK(QuadricEmitter(shape_of(Sphere{2, -2, 2, 360}), Transform::scale(3, 3, -3), true).area() == doctest::Approx(144 * kPi));
  CHECK(QuadricEmitter(shape_of(Disk{0, 2, 1, 180}), Transform::scale(3, 2, 7), true).area() == doctest::Approx(1.5 * kPi * 6));
  CHECK(QuadricEmitter(shape_of(Cylinder{2, 0, 3, 360}), Transform::scale(1, 1, 2), true).area() == doctest::Approx(24 * kPi));
  // A spheroid's area in closed form.
  const double a = 1, c = 3, eccentricity = std::sqrt(1 - a * a / (c * c));
  const double area = kTau * a * a * (1 + c / (a * eccentricity) * std::asin(eccentricity));
  CHECK(QuadricEmitter(shape_of(Sphere{}), Transform::scale(1, 1, 3), true).area() == doctest::Approx(area).epsilon(1e-3));
}

TEST_CASE("bounds hold every sample") {
  Rng rng(3);
  for (const Shape& s : {shape_of(Sphere{}), shape_of(Sphere{}, kTurned), shape_of(Sphere{1, -0.3f, 0.8f, 220}, kSheared),
                         shape_of(Disk{0.2f, 1, 0.3f, 300}, kSheared), shape_of(Cylinder{0.7f, -0.5f, 0.9f, 250}, kSheared)}) {
    const QuadricEmitter e(s, s.to_world, true);
    const Bounds3 box = e.extent().box;
    const Vec3 slack = box.extent() * 1e-6f;
    const Bounds3 wide{box.min - slack, box.max + slack};
    const Vec3 p{3, -4, 5};
    for (int i = 0; i < 2000; ++i) {
      const float ux = rng.uniform(), uy = rng.uniform();
      if (const auto x = e.sample(p, {ux, uy})) REQUIRE(wide.contains(p + x->wi * x->distance));
    }
  }
}

}  // namespace
}  // namespace tyndall
