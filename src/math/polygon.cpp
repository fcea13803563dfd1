#include "math/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tyndall {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Twice the area of abc, positive where it turns left.
double turn(Point2 a, Point2 b, Point2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Where a function that is linear is 0, which is `in_a` at `a` and of the other sign at `b`: from the nearer, which the other
/// may be too far away from to be told from it.
Point2 between(Point2 a, Point2 b, double in_a, double in_b) {
  if (std::abs(in_a) > std::abs(in_b)) return between(b, a, in_b, in_a);
  const double t = in_a / (in_a - in_b);
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
}

}  // namespace

ConvexPolygon ConvexPolygon::hull(std::span<const Point2> points) {
  std::array<Point2, kMostOfHull> sorted;
  const std::size_t n = std::min(points.size(), kMostOfHull);
  if (n < 3) return {};
  std::copy_n(points.begin(), n, sorted.begin());
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(n),
            [](Point2 a, Point2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  // The lower chain from left to right, then the upper one back.
  std::array<Point2, kMostOfHull + 1> chain;
  std::size_t size = 0;
  const auto add = [&](Point2 p, std::size_t least) {
    while (size >= least && turn(chain[size - 2], chain[size - 1], p) <= 0) --size;
    chain[size++] = p;
  };
  for (std::size_t i = 0; i < n; ++i) add(sorted[i], 2);
  const std::size_t least = size + 1;
  for (std::size_t i = n - 1; i-- > 0;) add(sorted[i], least);
  ConvexPolygon hull;
  if (size < 4) return hull;  // the last is the first again
  for (std::size_t i = 0; i < std::min(size - 1, kCornersOfHull); ++i) hull.push(chain[i]);
  return hull;
}

double ConvexPolygon::area() const {
  double sum = 0;
  for (std::size_t i = 2; i < size_; ++i) sum += turn(corners_[0], corners_[i - 1], corners_[i]);
  return std::max(0.5 * sum, 0.0);
}

Rectangle ConvexPolygon::bounds() const {
  Rectangle box{{kEndless, kEndless}, {-kEndless, -kEndless}};
  for (const Point2& p : corners()) {
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y)};
  }
  return box;
}

double ConvexPolygon::area_below(int axis, double limit) const {
  // The part's corners one after the other, as in keep(), and the triangles that they make with the first.
  double sum = 0;
  std::optional<Point2> first, last;
  const auto add = [&](Point2 p) {
    if (!first) {
      first = p;
    } else if (last) {
      sum += turn(*first, *last, p);
    }
    last = p;
  };
  for (std::size_t i = 0; i < size_; ++i) {
    const Point2 a = corners_[i], b = corners_[i + 1 < size_ ? i + 1 : 0];
    const double in_a = limit - a[axis], in_b = limit - b[axis];
    if (in_a >= 0) add(a);
    if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0)) add(between(a, b, in_a, in_b));
  }
  return std::max(0.5 * sum, 0.0);
}

template <typename Inside>
void ConvexPolygon::keep(const Inside& inside) {
  if (std::all_of(corners_.begin(), corners_.begin() + static_cast<std::ptrdiff_t>(size_),
                  [&](Point2 p) { return inside(p) >= 0; }))
    return;
  ConvexPolygon kept;
  for (std::size_t i = 0; i < size_; ++i) {
    const Point2 a = corners_[i], b = corners_[i + 1 < size_ ? i + 1 : 0];
    const double in_a = inside(a), in_b = inside(b);
    if (in_a >= 0) kept.push(a);
    if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0)) kept.push(between(a, b, in_a, in_b));
  }
  *this = kept;
}

ConvexPolygon ConvexPolygon::cut(const Rectangle& r) const {
  ConvexPolygon part = *this;
  for (const int axis : {0, 1}) {
    part.keep([&](Point2 p) { return p[axis] - r.min[axis]; });
    part.keep([&](Point2 p) { return r.max[axis] - p[axis]; });
  }
  return part;
}

ConvexPolygon ConvexPolygon::cut(const ConvexPolygon& other) const {
  ConvexPolygon part = other.empty() ? ConvexPolygon() : *this;
  for (std::size_t i = 0; i < other.size_; ++i) {
    const Point2 a = other.corners_[i], b = other.corners_[i + 1 < other.size_ ? i + 1 : 0];
    part.keep([&](Point2 p) { return turn(a, b, p); });
  }
  return part;
}

ConvexPolygon ConvexPolygon::moved(Point2 by) const {
  ConvexPolygon moved = *this;
  for (std::size_t i = 0; i < size_; ++i) moved.corners_[i] = {corners_[i].x + by.x, corners_[i].y + by.y};
  return moved;
}

bool ConvexPolygon::holds(Point2 p) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (turn(corners_[i], corners_[i + 1 < size_ ? i + 1 : 0], p) < 0) return false;
  }
  return size_ >= 3;
}

bool ConvexPolygon::covers(const Rectangle& r) const {
  return holds(r.min) && holds(r.max) && holds({r.min.x, r.max.y}) && holds({r.max.x, r.min.y});
}

Point2 ConvexPolygon::sample(Vec2 u) const {
  double left = u.x * 2 * area(), of_triangle = 0;
  std::size_t i = 2;
  for (; i < size_; ++i) {
    of_triangle = std::max(turn(corners_[0], corners_[i - 1], corners_[i]), 0.0);
    if (left < of_triangle || i + 1 == size_) break;
    left -= of_triangle;
  }
  // Uniform on a triangle [Turk 1990].
  const double along = of_triangle > 0 ? std::clamp(left / of_triangle, 0.0, 1.0) : 0.0;
  const double root = std::sqrt(along), b = root * (1 - u.y), c = root * u.y, a = 1 - root;
  const Point2 p = corners_[0], q = corners_[i - 1], r = corners_[i];
  return {a * p.x + b * q.x + c * r.x, a * p.y + b * q.y + c * r.y};
}

}  // namespace tyndall
