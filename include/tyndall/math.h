/// Small value types shared by every part of Tyndall: vectors, colours, bounds, transforms.
/// Lengths are in scene units, angles in radians, colours linear Rec.709 RGB unless said otherwise.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace tyndall {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 1.0f / kPi;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;  ///< largest float below 1

struct Vec2 {
  float x = 0, y = 0;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.y * s}; }
constexpr Vec2 operator*(float s, Vec2 a) { return a * s; }

/// A point, direction or normal; which one is said where it is used.
struct Vec3 {
  float x = 0, y = 0, z = 0;
  constexpr float operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr float& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr bool operator==(const Vec3&) const = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(float s, Vec3 a) { return a * s; }
constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec3 operator/(Vec3 a, float s) { return a * (1.0f / s); }
constexpr Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }
constexpr Vec3& operator*=(Vec3& a, float s) { return a = a * s; }

constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr float abs_dot(Vec3 a, Vec3 b) { return std::max(dot(a, b), -dot(a, b)); }
constexpr Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
constexpr float length_squared(Vec3 a) { return dot(a, a); }
inline float length(Vec3 a) { return std::sqrt(length_squared(a)); }
/// Unit vector along `a`; a zero vector stays zero.
inline Vec3 normalize(Vec3 a) {
  const float l = length(a);
  return l > 0 ? a / l : a;
}
constexpr Vec3 face_forward(Vec3 n, Vec3 v) { return dot(n, v) < 0 ? -n : n; }
constexpr Vec3 min(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
constexpr Vec3 max(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
inline bool is_finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// A linear RGB triple: radiance, reflectance or a coefficient per channel.
struct Rgb {
  float r = 0, g = 0, b = 0;
  constexpr Rgb() = default;
  constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}
  constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}
  constexpr float operator[](int i) const { return i == 0 ? r : (i == 1 ? g : b); }
  constexpr float& operator[](int i) { return i == 0 ? r : (i == 1 ? g : b); }
  constexpr bool operator==(const Rgb&) const = default;
};

constexpr Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Rgb operator-(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Rgb operator*(Rgb a, float s) { return {a.r * s, a.g * s, a.b * s}; }
constexpr Rgb operator*(float s, Rgb a) { return a * s; }
constexpr Rgb operator/(Rgb a, float s) { return a * (1.0f / s); }
constexpr Rgb& operator+=(Rgb& a, Rgb b) { return a = a + b; }
constexpr Rgb& operator*=(Rgb& a, Rgb b) { return a = a * b; }
constexpr Rgb& operator*=(Rgb& a, float s) { return a = a * s; }

constexpr float max_component(Rgb c) { return std::max({c.r, c.g, c.b}); }
constexpr float sum(Rgb c) { return c.r + c.g + c.b; }
constexpr float mean(Rgb c) { return sum(c) * (1.0f / 3.0f); }
constexpr bool is_black(Rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }
/// Relative luminance Y of a linear Rec.709 colour.
constexpr float luminance(Rgb c) { return 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b; }
inline bool is_finite(Rgb c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }
constexpr Rgb clamp(Rgb c, float low, float high) {
  return {std::clamp(c.r, low, high), std::clamp(c.g, low, high), std::clamp(c.b, low, high)};
}
inline Rgb absolute(Rgb c) { return {std::abs(c.r), std::abs(c.g), std::abs(c.b)}; }
inline Rgb exp(Rgb c) { return {std::exp(c.r), std::exp(c.g), std::exp(c.b)}; }

/// Axis-aligned box; empty (min > max) when default-constructed.
struct Bounds3 {
  Vec3 min{kInfinity, kInfinity, kInfinity};
  Vec3 max{-kInfinity, -kInfinity, -kInfinity};

  constexpr bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  constexpr Vec3 center() const { return (min + max) * 0.5f; }
  constexpr Vec3 extent() const { return max - min; }
  constexpr void expand(Vec3 p) {
    min = tyndall::min(min, p);
    max = tyndall::max(max, p);
  }
  constexpr void expand(const Bounds3& b) {
    min = tyndall::min(min, b.min);
    max = tyndall::max(max, b.max);
  }
  constexpr bool contains(Vec3 p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
  }
  constexpr Vec3 corner(int i) const { return {(i & 1) ? max.x : min.x, (i & 2) ? max.y : min.y, (i & 4) ? max.z : min.z}; }
};

/// A half-line o + t d, t > 0. `d` has unit length unless said otherwise.
struct Ray {
  Vec3 o, d;
  constexpr Vec3 at(float t) const { return o + d * t; }
};

/// An invertible affine map kept with its inverse, in double precision, row-major (column vectors).
class Transform {
 public:
  using Matrix = std::array<std::array<double, 4>, 4>;

  Transform();  ///< identity
  /// Throws Error (scene) when `m` is singular or not finite.
  explicit Transform(const Matrix& m);

  static Transform translate(double x, double y, double z);
  static Transform scale(double x, double y, double z);
  /// Right-handed rotation by `degrees` about `axis` (need not be unit).
  static Transform rotate(double degrees, double x, double y, double z);
  /// World to camera: camera at `eye`, +z toward `look`, as pbrt's LookAt.
  static Transform look_at(Vec3 eye, Vec3 look, Vec3 up);

  Vec3 point(Vec3 p) const;
  Vec3 vector(Vec3 v) const;
  Vec3 normal(Vec3 n) const;  ///< by the inverse transpose; not normalised
  Bounds3 bounds(const Bounds3& b) const;

  Transform inverse() const;
  Transform operator*(const Transform& b) const;  ///< first b, then this
  double determinant() const;                     ///< of the linear part
  bool swaps_handedness() const;                  ///< determinant < 0
  bool is_identity() const;
  const Matrix& matrix() const { return m_; }

 private:
  Transform(const Matrix& m, const Matrix& inverse) : m_(m), inverse_(inverse) {}
  Matrix m_, inverse_;
};

}  // namespace tyndall
