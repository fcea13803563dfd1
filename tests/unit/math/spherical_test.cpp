#include "math/spherical.h"

#include <doctest/doctest.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "math/rng.h"
#include "support/chi_squared.h"
#include "support/relative.h"

namespace tyndall {
namespace {

constexpr double kPi64 = 3.14159265358979323846;

Vec2 next_2d(const test::Uniform& random) {
  const float x = random();
  return {x, random()};
}

/// Whether the ray from the origin along w passes through the triangle, with a margin on the edges.
bool inside(Vec3d w, Vec3d a, Vec3d b, Vec3d c, double margin) {
  const double flip = dot(a, cross(b, c)) < 0 ? -1 : 1;
  const auto side = [&](Vec3d p, Vec3d q) { return dot(w, normalize(cross(p, q))) * flip; };
  return side(a, b) > -margin && side(b, c) > -margin && side(c, a) > -margin;
}

struct Triangle {
  std::string name;
  Vec3d a, b, c;
};

const Triangle kTriangles[] = {
    {"an octant", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {"of uneven distances", {3, 0.2, 0.1}, {-0.1, 0.4, 0.2}, {0.3, -0.2, 5}},
    {"nearly a hemisphere", {1, 0, 0.001}, {-0.6, 0.9, 0.001}, {-0.5, -0.8, 0.001}},
    {"small", {0, 0, 1}, {0.05, 0, 1}, {0, 0.03, 1}},
    {"obtuse", {-1, 0.02, 1}, {1, 0.01, 1}, {0.1, -0.3, 1}},
    {"a needle", {0, 0, 1}, {0.7, 0, 1}, {0.7, 0.002, 1}},
    {"a thin needle", {0, 0, 1}, {0.7, 0, 1}, {0.7, 2e-6, 1}},
    {"the thinnest needle", {0, 0, 1}, {0.7, 0, 1}, {0.7, 2e-8, 1}},
    {"a blunt needle", {0, 0, 1}, {1e-6, 0, 1}, {0.7, 0.3, 1}},
    {"tiny", {0.2, 0.1, 1}, {0.2 + 1e-4, 0.1, 1}, {0.2, 0.1 + 1e-4, 1}},
    {"grazing", {1, 0, 1e-3}, {2, 0.5, 1e-3}, {2, -1, 1e-3}},
    {"over the observer", {3, 0, 1e-4}, {-2, 2, 1e-4}, {-2, -2, 1e-4}},
};
constexpr std::size_t kWideTriangles = 5;  // those that bins of directions can resolve

TEST_CASE("spherical triangles: samples are uniform over the solid angle") {
  for (const Triangle& t : std::span(kTriangles).first(kWideTriangles)) {
    const SphericalTriangle s(t.a, t.b, t.c);
    const auto result =
        test::chi_squared_test([&](const test::Uniform& random) { return to_vec3(s.sample(next_2d(random))); },
                               [&](Vec3 w) { return inside(Vec3d(w), t.a, t.b, t.c, 2e-7) ? 1 / s.solid_angle() : 0; },
                               {.samples = 50'000,
                                .axis = to_vec3(normalize(normalize(t.a) + normalize(t.b) + normalize(t.c))),
                                .theta_power = 3,
                                .alpha = test::sidak(1e-3, kWideTriangles)});
    CHECK_MESSAGE(result.passed, t.name, ": ", result.summary());
    CHECK_MESSAGE(result.density_integral == doctest::Approx(1).epsilon(0.01), t.name);
  }
}

/// p-value of counts in cells of known probability.
double p_value(const std::vector<double>& counts, const std::vector<double>& probabilities, double samples) {
  double statistic = 0, cells = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double e = probabilities[i] * samples;
    statistic += (counts[i] - e) * (counts[i] - e) / std::max(e, 5.0);
    cells += e > 0 ? 1 : 0;
  }
  return test::chi_squared_tail(statistic, cells - 1);
}

TEST_CASE("spherical triangles: each part of one gets samples in proportion to its solid angle") {
  constexpr int kCuts = 6, kSamples = 40'000;
  for (const Triangle& t : kTriangles) {
    const SphericalTriangle whole(t.a, t.b, t.c);
    const Vec3d e1 = t.b - t.a, e2 = t.c - t.a, n = cross(e1, e2);
    const auto point = [&](int i, int j) { return t.a + e1 * (double(i) / kCuts) + e2 * (double(j) / kCuts); };
    // Cells of the grid in barycentric coordinates; those on the diagonal are triangles, others are cut in two.
    std::vector<double> probability(kCuts * kCuts), count(kCuts * kCuts);
    double sum = 0;
    for (int i = 0; i < kCuts; ++i)
      for (int j = 0; i + j < kCuts; ++j) {
        double omega = SphericalTriangle(point(i, j), point(i + 1, j), point(i, j + 1)).solid_angle();
        if (i + j + 1 < kCuts) omega += SphericalTriangle(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)).solid_angle();
        probability[i * kCuts + j] = omega / whole.solid_angle();
        sum += omega;
      }
    CHECK_MESSAGE(sum == test::relative(whole.solid_angle()).epsilon(1e-6), t.name);
    Rng rng(17);
    for (int k = 0; k < kSamples; ++k) {
      const Vec3d w = whole.sample({rng.uniform(), rng.uniform()});
      REQUIRE(length(w) == doctest::Approx(1).epsilon(1e-9));
      const Vec3d h = w * (dot(t.a, n) / dot(w, n)) - t.a;
      const double b1 = dot(cross(h, e2), n) / dot(n, n), b2 = dot(cross(e1, h), n) / dot(n, n);
      const int i = std::clamp(int(b1 * kCuts), 0, kCuts - 1), j = std::clamp(int(b2 * kCuts), 0, kCuts - 1 - i);
      count[i * kCuts + j] += 1;
    }
    CHECK_MESSAGE(p_value(count, probability, kSamples) > 1e-4, t.name);
  }
}

/// Area of a flat triangle over its squared distance, times the cosine: the solid angle of a very small one.
double small_solid_angle(Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d m = (a + b + c) / 3;
  return 0.5 * std::abs(dot(cross(b - a, c - a), m)) / (dot(m, m) * length(m));
}

TEST_CASE("spherical triangles: no sample lies beyond an edge, whichever corner is the sharp one") {
  constexpr float kLast = 0x1.fffffep-1f;
  for (const Triangle& t : kTriangles) {
    for (const auto& [a, b, c] : {std::array{t.a, t.b, t.c}, std::array{t.b, t.c, t.a}, std::array{t.c, t.a, t.b}}) {
      const SphericalTriangle s(a, b, c);
      const Vec3d e1 = b - a, e2 = c - a, n = cross(e1, e2);
      Rng rng(5);
      double beyond = 0;
      for (int k = 0; k < 3000; ++k) {
        const Vec2 u{k % 3 == 0 ? kLast : rng.uniform(), k % 5 == 0 ? kLast : k % 5 == 1 ? 0.0f : rng.uniform()};
        const Vec3d w = s.sample(u), h = w * (dot(a, n) / dot(w, n)) - a;
        const double b1 = dot(cross(h, e2), n) / dot(n, n), b2 = dot(cross(e1, h), n) / dot(n, n);
        beyond = std::max({beyond, -b1, -b2, b1 + b2 - 1});
      }
      CHECK_MESSAGE(beyond < 1e-5, t.name);
    }
  }
}

TEST_CASE("spherical triangles: the solid angle of special cases") {
  CHECK(SphericalTriangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}).solid_angle() == doctest::Approx(kPi64 / 2).epsilon(1e-14));
  CHECK(SphericalTriangle({1, 0, 0}, {0, 7, 0}, {-2, -3, 0}).solid_angle() == doctest::Approx(2 * kPi64));
  CHECK(SphericalTriangle({1, 0, 0}, {2, 1, 0}, {2, -1, 0}).solid_angle() == 0);
  for (const double size : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const Vec3d a{0.3, 0.4, 1}, b = a + Vec3d(size, 0, 0.2 * size), c = a + Vec3d(0.1 * size, size, 0);
    CHECK(SphericalTriangle(a, b, c).solid_angle() / small_solid_angle(a, b, c) == doctest::Approx(1).epsilon(3 * size + 1e-7));
  }
  // Scaling changes nothing, however far.
  const double unit = SphericalTriangle({3, 0.2, 0.1}, {-0.1, 0.4, 0.2}, {0.3, -0.2, 5}).solid_angle();
  for (const double k : {1e-30, 1e30})
    CHECK(SphericalTriangle(Vec3d{3, 0.2, 0.1} * k, Vec3d{-0.1, 0.4, 0.2} * k, Vec3d{0.3, -0.2, 5} * k).solid_angle() ==
          doctest::Approx(unit).epsilon(1e-12));
}

struct Rectangle {
  std::string name;
  Vec3d corner, x, y;
};

const Rectangle kRectangles[] = {
    {"a face of a cube", {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}},
    {"off to one side", {0.5, 1, 0.7}, {2, 0, 0}, {0, 0.5, 0}},
    {"turned", {0.4, 0.1, 1}, {0.5, 0.5, 0}, {-0.3, 0.3, 0.3 * 1.4142135623730951}},
    {"close", {-1, -2, -0.01}, {3, 0, 0}, {0, 4, 0}},
    {"small", {0.3, 0.2, 2}, {0.05, 0, 0}, {0, 0.05, 0}},
    {"a strip", {-3, 0.2, 0.5}, {6, 0, 0}, {0, 0.01, 0}},
    {"grazing", {1, 0.5, 0.002}, {1, 0, 0}, {0, 1, 0}},
    {"tiny", {0.5, 0.2, -2}, {1e-4, 0, 0}, {0, 3e-4, 0}},
    {"above the observer", {-1, -2, -1e-5}, {3, 0, 0}, {0, 4, 0}},
    {"an edge overhead", {-1, 0, 0.5}, {3, 0, 0}, {0, 4, 0}},
};

TEST_CASE("spherical rectangles: each part of one gets samples in proportion to its solid angle") {
  constexpr int kCuts = 6, kSamples = 40'000;
  for (const Rectangle& r : kRectangles) {
    const SphericalRectangle whole(r.corner, r.x, r.y);
    std::vector<double> probability, count(kCuts * kCuts);
    double sum = 0;
    for (int i = 0; i < kCuts; ++i)
      for (int j = 0; j < kCuts; ++j) {
        const Vec3d a = r.corner + r.x * (double(i) / kCuts) + r.y * (double(j) / kCuts);
        const Vec3d x = r.x / kCuts, y = r.y / kCuts;
        const double omega =
            SphericalTriangle(a, a + x, a + x + y).solid_angle() + SphericalTriangle(a, a + x + y, a + y).solid_angle();
        probability.push_back(omega / whole.solid_angle());
        sum += omega;
      }
    CHECK_MESSAGE(sum == test::relative(whole.solid_angle()).epsilon(1e-6), r.name);
    Rng rng(19);
    for (int k = 0; k < kSamples; ++k) {
      const auto s = whole.sample({rng.uniform(), rng.uniform()});
      REQUIRE(length(r.corner + r.x * s.uv.x + r.y * s.uv.y - s.p) < 1e-5 * (length(r.x) + length(r.y)));
      const int i = std::clamp(int(s.uv.x * kCuts), 0, kCuts - 1), j = std::clamp(int(s.uv.y * kCuts), 0, kCuts - 1);
      count[i * kCuts + j] += 1;
    }
    CHECK_MESSAGE(p_value(count, probability, kSamples) > 1e-4, r.name);
  }
}

TEST_CASE("spherical rectangles: the solid angle is that of two triangles") {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&] { return 2 * rng.uniform_wide() - 1; };
    const double size = std::pow(10.0, -4 * rng.uniform_wide());
    const Vec3d corner{number(), number(), number()};
    const Vec3d x = Vec3d(number(), number(), number()) * size;
    const Vec3d y = cross(x, Vec3d(number(), number(), number()));
    const SphericalRectangle r(corner, x, y);
    const double expected = SphericalTriangle(corner, corner + x, corner + x + y).solid_angle() +
                            SphericalTriangle(corner, corner + x + y, corner + y).solid_angle();
    REQUIRE(r.solid_angle() == doctest::Approx(expected).epsilon(1e-5).scale(1e-8));
    const auto s = r.sample({rng.uniform(), rng.uniform()});
    REQUIRE(length(corner + x * s.uv.x + y * s.uv.y - s.p) < 1e-5 * (length(x) + length(y)));
  }
}

TEST_CASE("the cone a sphere is seen under") {
  CHECK(!sphere_cone_height(1, 1));
  CHECK(!sphere_cone_height(0.3, 1));
  CHECK(*sphere_cone_height(2, 1) == doctest::Approx(1 - std::sqrt(0.75)).epsilon(1e-14));
  CHECK(*sphere_cone_height(1e9, 1) == test::relative(0.5e-18).epsilon(1e-12));
}

}  // namespace
}  // namespace tyndall
