/// Convex polygons against brute force.
#include "math/polygon.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/rng.h"
#include "support/chi_squared.h"

namespace tyndall {
namespace {

double turn(Point2 a, Point2 b, Point2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

std::vector<Point2> random_points(std::size_t count, Rng& rng) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({2.0 * rng.uniform() - 1, 3.0 * rng.uniform() - 1});
  return points;
}

bool holds(const ConvexPolygon& polygon, Point2 p, double slack) {
  const auto corners = polygon.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (turn(corners[i], corners[(i + 1) % corners.size()], p) < -slack) return false;
  }
  return !polygon.empty();
}

TEST_CASE("a hull turns left at each corner, has only given points and holds all of them") {
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const auto points = random_points(3 + static_cast<std::size_t>(13 * rng.uniform()), rng);
    const ConvexPolygon hull = ConvexPolygon::hull(points);
    const auto corners = hull.corners();
    REQUIRE(corners.size() >= 3);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t n = corners.size();
      REQUIRE(turn(corners[k], corners[(k + 1) % n], corners[(k + 2) % n]) > 0);
      const auto same = [&](Point2 p) { return p.x == corners[k].x && p.y == corners[k].y; };
      REQUIRE(std::any_of(points.begin(), points.end(), same));
    }
    for (const Point2& p : points) REQUIRE(holds(hull, p, 1e-12));
  }
}

TEST_CASE("points on a line, or in one place, have no hull") {
  CHECK(ConvexPolygon::hull(std::vector<Point2>{}).empty());
  CHECK(ConvexPolygon::hull(std::vector<Point2>{{0, 0}, {1, 1}}).empty());
  CHECK(ConvexPolygon::hull(std::vector<Point2>{{0, 0}, {1, 1}, {2, 2}, {0.5, 0.5}}).empty());
  CHECK(ConvexPolygon::hull(std::vector<Point2>(5, Point2{3, 4})).empty());
  CHECK(ConvexPolygon::hull(std::vector<Point2>{{0, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 0}}).area() == doctest::Approx(0.5));
}

TEST_CASE("what is cut off lies outside, and the parts' areas add up") {
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    const ConvexPolygon whole = ConvexPolygon::hull(random_points(12, rng));
    const double x = 2.4 * rng.uniform() - 1.2, y = 3.6 * rng.uniform() - 1.2;
    double sum = 0;
    for (const Rectangle& r : {Rectangle{{-9, -9}, {x, y}}, {{x, -9}, {9, y}}, {{-9, y}, {x, 9}}, {{x, y}, {9, 9}}}) {
      const ConvexPolygon part = whole.cut(r);
      sum += part.area();
      for (const Point2& p : part.corners()) {
        REQUIRE(std::min({p.x - r.min.x, p.y - r.min.y, r.max.x - p.x, r.max.y - p.y}) >= -1e-12);
        REQUIRE(holds(whole, p, 1e-12));
      }
    }
    REQUIRE(sum == doctest::Approx(whole.area()).epsilon(1e-12));
    REQUIRE(whole.area_below(0, x) == doctest::Approx(whole.cut({{-9, -9}, {x, 9}}).area()).epsilon(1e-12));
    REQUIRE(whole.area_below(1, y) == doctest::Approx(whole.cut({{-9, -9}, {9, y}}).area()).epsilon(1e-12));
    const Rectangle box = whole.bounds(), around{{box.min.x + 0.3, box.min.y + 0.3}, {box.max.x - 0.3, box.max.y - 0.3}};
    const bool covered = whole.covers(around) && around.min.x < around.max.x && around.min.y < around.max.y;
    const double area = (around.max.x - around.min.x) * (around.max.y - around.min.y);
    if (covered) REQUIRE(whole.cut(around).area() == doctest::Approx(area).epsilon(1e-12));
    if (!covered && area > 0) REQUIRE(whole.cut(around).area() < area);
  }
}

TEST_CASE("what two polygons share is in both, and as large from either side") {
  Rng rng(4);
  for (int i = 0; i < 2000; ++i) {
    const ConvexPolygon a = ConvexPolygon::hull(random_points(8, rng)), b = ConvexPolygon::hull(random_points(8, rng));
    const ConvexPolygon part = a.cut(b);
    REQUIRE(part.area() == doctest::Approx(b.cut(a).area()).epsilon(1e-9));
    for (const Point2& p : part.corners()) REQUIRE((holds(a, p, 1e-12) && holds(b, p, 1e-12)));
    for (int k = 0; k < 20; ++k) {
      const Point2 p{2.0 * rng.uniform() - 1, 3.0 * rng.uniform() - 1};
      REQUIRE(part.holds(p) == (a.holds(p) && b.holds(p)));
    }
  }
  CHECK(ConvexPolygon::hull(random_points(8, rng)).cut(ConvexPolygon()).empty());
}

TEST_CASE("a polygon's places are uniform in it") {
  Rng rng(3);
  constexpr int kPolygons = 5, kDraws = 100'000, kCells = 12;
  for (int i = 0; i < kPolygons; ++i) {
    const ConvexPolygon polygon = ConvexPolygon::hull(random_points(5, rng)).moved({0.5, -2});
    const Rectangle box = polygon.bounds();
    std::vector<double> counts(kCells * kCells), pmf;
    const auto at = [&](int k, int axis) { return box.min[axis] + (box.max[axis] - box.min[axis]) * k / kCells; };
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x)
        pmf.push_back(polygon.cut({{at(x, 0), at(y, 1)}, {at(x + 1, 0), at(y + 1, 1)}}).area() / polygon.area());
    }
    for (int k = 0; k < kDraws; ++k) {
      const float u = rng.uniform(), v = rng.uniform();
      const Point2 p = polygon.sample({u, v});
      REQUIRE(holds(polygon, p, 1e-12));
      const auto cell = [&](int axis) {
        return std::min(static_cast<std::size_t>((p[axis] - box.min[axis]) / (box.max[axis] - box.min[axis]) * kCells),
                        std::size_t{kCells - 1});
      };
      ++counts[cell(1) * kCells + cell(0)];
    }
    CHECK(test::count_p_value(counts, pmf, kDraws) > test::sidak(1e-3, kPolygons));
  }
}

}  // namespace
}  // namespace tyndall
