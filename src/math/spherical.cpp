#include "math/spherical.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {

// Tan of half the solid angle [Van Oosterom and Strackee 1983], with the determinant taken from the edges: for small
// triangles the three positions are nearly equal, and their own determinant would cancel.
SphericalTriangle::SphericalTriangle(Vec3d a, Vec3d b, Vec3d c) : a_(a), b_(b), c_(c) {
  normal_ = cross(b - a, c - a);
  volume_ = std::abs(dot(a, normal_));
  const double la = length(a), lb = length(b), lc = length(c);
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
  solid_angle_ = la * lb * lc > 0 ? 2 * std::atan2(volume_, denominator) : 0;  // at a vertex all that is rounding
}

namespace {

/// Unit vector perpendicular to unit `from`, toward unit `to`.
Vec3d tangent(Vec3d from, Vec3d to) {
  const Vec3d d = to - from;
  return normalize(d - from * dot(d, from));
}

}  // namespace

// Stratified sampling of spherical triangles [Arvo 1995]: cut off a part A B C' with u.x of the area, then a point on
// the arc B C'. Arvo's q = cos b' cancels for small triangles; we use instead, with alpha the angle at A and c the
// side A B,
//   tan(area'/2) = tan(c/2) tan(b'/2) sin alpha / (1 + tan(c/2) tan(b'/2) cos alpha)
//   => tan(b'/2) = sin(area'/2) / (tan(c/2) sin(alpha - area'/2)),
// and half angles on the arc as well.
Vec3d SphericalTriangle::sample(Vec2 u) const {
  const Vec3d A = normalize(a_), B = normalize(b_), C = normalize(c_);
  const double alpha = std::atan2(length(a_) * volume_, dot(cross(a_, b_ - a_), cross(a_, c_ - a_)));
  const double half_area = 0.5 * solid_angle_ * u.x;
  const double tan_half_c = length(A - B) / length(A + B);

  // C' on the arc A C. Rounding must not carry it beyond C.
  const double denominator = tan_half_c * std::sin(alpha - half_area);
  const double limit = length(A - C) / length(A + C);
  const double t = denominator > 0 ? std::min(std::sin(half_area) / denominator, limit) : limit;
  const double cos_b = (1 - t * t) / (1 + t * t), sin_b = 2 * t / (1 + t * t);
  const Vec3d C1 = std::isfinite(t) ? A * cos_b + tangent(A, C) * sin_b : C;

  // The height above B is uniform in the cosine: sin^2 of half the angle is proportional to u.y.
  const double s = std::sqrt(static_cast<double>(u.y)) * std::min(0.5 * length(C1 - B), 1.0);
  return normalize(B * (1 - 2 * s * s) + tangent(B, C1) * (2 * s * std::sqrt(std::max(0.0, 1 - s * s))));
}

namespace {

/// Interior angle at a corner of the projected rectangle at depth z: acos(-xy / sqrt((x^2+z^2)(y^2+z^2))), with the
/// sine written out so that no digits are lost near 0 and pi. `x` and `y` are measured outward from the rectangle.
double corner_angle(double x, double y, double z) { return std::atan2(std::abs(z) * std::sqrt(x * x + y * y + z * z), -x * y); }

}  // namespace

SphericalRectangle::SphericalRectangle(Vec3d corner, Vec3d edge_x, Vec3d edge_y)
    : length_x_(length(edge_x)), length_y_(length(edge_y)) {
  x_ = edge_x / length_x_;
  y_ = edge_y / length_y_;
  z_ = normalize(cross(x_, y_));
  z0_ = dot(corner, z_);
  if (z0_ > 0) {
    z_ = -z_;
    z0_ = -z0_;
  }
  x0_ = dot(corner, x_);
  x1_ = x0_ + length_x_;
  y0_ = dot(corner, y_);
  y1_ = y0_ + length_y_;

  // Inner angles of the spherical quadrilateral, in the paper's order of corners.
  const double g0 = corner_angle(x1_, -y0_, z0_), g1 = corner_angle(x1_, y1_, z0_);
  const double g2 = corner_angle(-x0_, y1_, z0_), g3 = corner_angle(-x0_, -y0_, z0_);
  const auto sine = [&](double y) { return y == 0 ? y : y / std::hypot(z0_, y); };  // y and z0 are 0 along an edge
  b0_ = sine(-y0_);
  b1_ = sine(y1_);
  k_ = 2 * 3.14159265358979323846 - g2 - g3;
  solid_angle_ = z0_ < 0 ? std::max(0.0, g0 + g1 - k_) : 0;
}

SphericalRectangle::Sample SphericalRectangle::sample(Vec2 u) const {
  // x such that the part of the rectangle left of it has u.x of the solid angle.
  const double au = u.x * solid_angle_ + k_;
  const double sine = std::sin(au);
  const double fu = sine == 0 ? std::numeric_limits<double>::quiet_NaN() : (std::cos(au) * b0_ - b1_) / sine;
  const double cu = std::copysign(1 / std::sqrt(fu * fu + b0_ * b0_), fu);
  const double c = std::clamp(cu, -1.0, 1.0);
  double x = std::clamp(-c * z0_ / std::sqrt(std::max(1e-300, (1 - c) * (1 + c))), x0_, x1_);
  if (std::isnan(x)) x = std::lerp(x0_, x1_, double{u.x});  // seen so obliquely that its angles say nothing

  // y: along the line x = const, the sine of the elevation is uniform.
  const double d2 = x * x + z0_ * z0_;
  const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
  const double h = h0 + u.y * (h1 - h0);
  const double y = std::clamp(h * std::sqrt(d2) / std::sqrt(std::max(1e-300, (1 - h) * (1 + h))), y0_, y1_);

  const auto share = [](double length, double whole) { return static_cast<float>(std::clamp(length / whole, 0.0, 1.0)); };
  return {x_ * x + y_ * y + z_ * z0_, {share(x - x0_, length_x_), share(y - y0_, length_y_)}};
}

std::optional<double> sphere_cone_height(double distance, double radius) {
  if (!(distance > radius)) return std::nullopt;
  const double sine = radius / distance;
  return sine * sine / (1 + std::sqrt((1 - sine) * (1 + sine)));
}

}  // namespace tyndall
