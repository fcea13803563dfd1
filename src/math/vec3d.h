/// Double-precision vectors for geometry whose differences and squares would not fit a float.
#pragma once

#include <algorithm>
#include <cmath>

#include "tyndall/math.h"

namespace tyndall {

struct Vec3d {
  double x = 0, y = 0, z = 0;
  constexpr Vec3d() = default;
  constexpr Vec3d(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  constexpr explicit Vec3d(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
};

constexpr Vec3d operator+(Vec3d a, Vec3d b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3d operator-(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3d operator-(Vec3d a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3d operator*(Vec3d a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3d operator/(Vec3d a, double s) { return {a.x / s, a.y / s, a.z / s}; }
constexpr double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3d cross(Vec3d a, Vec3d b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3d a) { return std::sqrt(dot(a, a)); }
/// Unit vector along `a`; a zero vector stays zero.
inline Vec3d normalize(Vec3d a) {
  const double l = length(a);
  return l > 0 ? a / l : a;
}
/// What roundings of its coordinates go by.
inline double largest_coordinate(Vec3d a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); }
/// Rounds to float.
constexpr Vec3 to_vec3(Vec3d a) { return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)}; }

}  // namespace tyndall
