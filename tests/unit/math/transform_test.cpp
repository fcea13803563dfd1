#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "tyndall/error.h"
#include "tyndall/math.h"

using namespace tyndall;

namespace {

void check_near(Vec3 a, Vec3 b, float tolerance = 1e-6f) {
  for (int i = 0; i < 3; ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(tolerance).scale(1));
}

Transform::Matrix linear(std::initializer_list<double> nine) {
  Transform::Matrix m{};
  auto v = nine.begin();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = *v++;
  m[3][3] = 1;
  return m;
}

}  // namespace

TEST_CASE("elementary transforms move points, vectors and normals") {
  check_near(Transform::translate(1, 2, 3).point({1, 1, 1}), {2, 3, 4});
  check_near(Transform::translate(1, 2, 3).vector({1, 1, 1}), {1, 1, 1});
  check_near(Transform::scale(2, 3, 4).point({1, 1, 1}), {2, 3, 4});
  check_near(Transform::scale(2, 4, 8).normal({1, 1, 1}), {0.5f, 0.25f, 0.125f});
  check_near(Transform::rotate(90, 0, 0, 1).point({1, 0, 0}), {0, 1, 0});
  check_near(Transform::rotate(90, 0, 2, 0).point({0, 0, 1}), {1, 0, 0});
  check_near(Transform::rotate(120, 1, 1, 1).vector({1, 0, 0}), {0, 1, 0});
  CHECK(Transform().is_identity());
  CHECK_FALSE(Transform::translate(0, 0, 1).is_identity());
}

TEST_CASE("a product applies the right factor first, and its inverse undoes it") {
  const Transform t = Transform::translate(1, 0, 0) * Transform::rotate(90, 0, 0, 1) * Transform::scale(2, 3, 4);
  check_near(t.point({1, 0, 0}), {1, 2, 0});
  for (const Vec3 p : {Vec3{1, 2, 3}, Vec3{-5, 0.1f, 7}}) check_near(t.inverse().point(t.point(p)), p);
  const Transform round = t * t.inverse();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) CHECK(round.matrix()[i][j] == doctest::Approx(i == j).epsilon(1e-14).scale(1));
}

TEST_CASE("normals stay perpendicular to their surface under shear and mirror") {
  const Transform t(linear({1, 0.5, 0, 0, -2, 0.3, 0.7, 0, 1}));
  const Vec3 a{1, 2, 0}, b{0, 1, 3}, n = cross(a, b);
  CHECK(std::abs(dot(t.normal(n), t.vector(a))) < 1e-5f);
  CHECK(std::abs(dot(t.normal(n), t.vector(b))) < 1e-5f);
}

TEST_CASE("handedness follows the sign of the determinant") {
  CHECK_FALSE(Transform::rotate(33, 1, 2, 3).swaps_handedness());
  CHECK(Transform::scale(-1, 1, 1).swaps_handedness());
  CHECK(Transform(linear({2, 1, 0, 0, 3, 0, 0, 0, -1})).determinant() == -6);
  CHECK_FALSE(Transform::scale(-1, -1, 1).swaps_handedness());
  CHECK(Transform(linear({0, 1, 0, 1, 0, 0, 0, 0, 1})).swaps_handedness());
}

TEST_CASE("look_at puts the eye at the origin and the target on +z, x to the right of pbrt's camera") {
  const Transform t = Transform::look_at({1, 2, 3}, {1, 2, 8}, {0, 1, 0});
  check_near(t.point({1, 2, 3}), {0, 0, 0});
  check_near(t.point({1, 2, 8}), {0, 0, 5});
  check_near(t.point({2, 2, 3}), {1, 0, 0});
  check_near(t.point({1, 3, 3}), {0, 1, 0});
  check_near(t.inverse().point({0, 0, 0}), {1, 2, 3});
  CHECK_FALSE(Transform::look_at({0, 1, -4}, {0.3f, 0, 0}, {0, 1, 0}).swaps_handedness());
}

TEST_CASE("bounds hold every transformed point, and empty stays empty") {
  const Transform t = Transform::rotate(37, 1, -2, 0.5) * Transform::translate(1e4, 3, -7) * Transform::scale(1, -3, 0.1);
  const Bounds3 box{{-1, -2, -3}, {4, 5, 6}}, moved = t.bounds(box);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      for (int k = 0; k <= 10; ++k) {
        const Vec3 p{-1 + 0.5f * i, -2 + 0.7f * j, -3 + 0.9f * k};
        CHECK(moved.contains(t.point(box.contains(p) ? p : box.max)));
      }
  CHECK(t.bounds(Bounds3{}).empty());
}

TEST_CASE("singular, projective and non-finite transforms are refused") {
  CHECK_THROWS_AS(Transform::scale(1, 0, 1), Error);
  CHECK_THROWS_AS(Transform::scale(1, 1, INFINITY), Error);
  CHECK_THROWS_AS(Transform::scale(1e-320, 1, 1), Error);
  CHECK_THROWS_AS(Transform::rotate(10, 0, 0, 0), Error);
  CHECK_THROWS_AS(Transform::rotate(NAN, 0, 0, 1), Error);
  CHECK_THROWS_AS(Transform::translate(NAN, 0, 0), Error);
  CHECK_THROWS_AS(Transform::look_at({0, 0, 0}, {0, 0, 0}, {0, 1, 0}), Error);
  CHECK_THROWS_AS(Transform::look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0}), Error);
  CHECK_THROWS_AS(Transform(linear({1, 2, 3, 4, 5, 6, 7, 8, 9})), Error);  // rank 2, but for rounding
  CHECK_THROWS_AS(Transform(linear({1, 0, 0, 0, NAN, 0, 0, 0, 1})), Error);
  Transform::Matrix projective = linear({1, 0, 0, 0, 1, 0, 0, 0, 1});
  projective[3][0] = 0.1;
  CHECK_THROWS_AS(Transform{projective}, Error);
}

TEST_CASE("very small, large and uneven scales are not singular") {
  check_near(Transform(linear({1e-12, 0, 0, 0, 1e-12, 0, 0, 0, 1e-12})).inverse().vector({1e-12f, 0, 0}), {1, 0, 0});
  CHECK_NOTHROW(Transform(linear({1e-4, 0, 0, 0, 1e8, 0, 0, 0, 1})));
  Transform::Matrix scaled = linear({2, 0, 0, 0, 2, 0, 0, 0, 2});
  scaled[3][3] = 2;  // homogeneous scale is divided out
  CHECK(Transform(scaled).is_identity());
}
