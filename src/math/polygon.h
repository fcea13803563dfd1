/// Convex polygons in a plane, in double precision: what the camera sees of a flat primitive.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "tyndall/math.h"

namespace tyndall {

struct Point2 {
  double x, y;
  double operator[](int axis) const { return axis == 0 ? x : y; }
};

/// Sides along the axes; empty where it does not begin before it ends.
struct Rectangle {
  Point2 min, max;
  bool holds(const Rectangle& r) const { return min.x <= r.min.x && min.y <= r.min.y && r.max.x <= max.x && r.max.y <= max.y; }
};

class ConvexPolygon {
 public:
  static constexpr std::size_t kMost = 40;           ///< corners
  static constexpr std::size_t kMostOfHull = 64;     ///< points
  static constexpr std::size_t kCornersOfHull = 32;  ///< at most

  ConvexPolygon() {}  // empty, its corners uninitialised
  /// The convex hull of at most kMostOfHull points [Andrew 1979]; of more than kCornersOfHull corners the last are left out.
  /// Empty where the points are on one line.
  static ConvexPolygon hull(std::span<const Point2> points);

  std::span<const Point2> corners() const { return {corners_.data(), size_}; }
  bool empty() const { return size_ < 3; }
  double area() const;
  /// Of the part whose x (axis 0) or y (axis 1) is below a limit.
  double area_below(int axis, double limit) const;
  Rectangle bounds() const;  ///< not when empty
  /// The part of it in the rectangle [Sutherland and Hodgman 1974]. Each cut adds a corner at most; what would exceed kMost is
  /// never asked for: a hull is cut by three rectangles, one within the other.
  ConvexPolygon cut(const Rectangle& rectangle) const;
  /// The part of it in another, with at most as many corners as both; what would exceed kMost is never asked for.
  ConvexPolygon cut(const ConvexPolygon& other) const;
  ConvexPolygon moved(Point2 by) const;
  bool holds(Point2 p) const;
  bool covers(const Rectangle& rectangle) const;
  /// Uniform in it, `u` in [0, 1)^2; not when empty.
  Point2 sample(Vec2 u) const;

 private:
  void push(Point2 p) {
    if (size_ < kMost) corners_[size_++] = p;
  }

  /// Leaves of it what is on one side of a line: where `inside`, which is linear, is not below 0.
  template <typename Inside>
  void keep(const Inside& inside);

  std::array<Point2, kMost> corners_;  ///< counterclockwise where y points up
  std::size_t size_ = 0;
};

}  // namespace tyndall
