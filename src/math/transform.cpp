/// Affine maps in double precision that keep their inverse, so that a scene's chain of transforms is never inverted late.
#include <cmath>
#include <utility>

#include "math/vec3d.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

using Matrix = Transform::Matrix;

constexpr Matrix kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

Error bad_transform(const std::string& what) { return Error(Failure::scene, what); }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

bool all_finite(const Matrix& m) {
  for (const auto& row : m)
    for (const double v : row)
      if (!std::isfinite(v)) return false;
  return true;
}

/// The bottom row becomes exactly 0 0 0 1; rounding errors of exporters are forgiven, a projection is not.
Matrix affine(const Matrix& m) {
  const double w = m[3][3];
  const double dust = 1e-6 * std::abs(w);
  if (w == 0 || std::abs(m[3][0]) > dust || std::abs(m[3][1]) > dust || std::abs(m[3][2]) > dust)
    throw bad_transform("transform is not affine; its last column in the scene file must be 0 0 0 1");
  Matrix a = m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) a[i][j] /= w;
  a[3] = {0, 0, 0, 1};
  return a;
}

/// Inverse of the linear part by Gauss-Jordan elimination with row pivoting, then of the translation.
Matrix inverse_of(const Matrix& m) {
  double a[3][6];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a[i][j] = m[i][j], a[i][j + 3] = i == j ? 1 : 0;

  for (int column = 0; column < 3; ++column) {
    int pivot = column;
    for (int i = column + 1; i < 3; ++i)
      if (std::abs(a[i][column]) > std::abs(a[pivot][column])) pivot = i;
    if (a[pivot][column] == 0) throw bad_transform("transform is singular; scale factors and axes must not be 0");
    std::swap(a[pivot], a[column]);
    const double p = a[column][column];
    for (double& v : a[column]) v /= p;
    for (int i = 0; i < 3; ++i) {
      if (i == column) continue;
      const double f = a[i][column];
      for (int j = 0; j < 6; ++j) a[i][j] -= f * a[column][j];
    }
  }

  Matrix inverse = kIdentity;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inverse[i][j] = a[i][j + 3];
    inverse[i][3] = -(a[i][3] * m[0][3] + a[i][4] * m[1][3] + a[i][5] * m[2][3]);
  }
  return inverse;
}

/// Columns of rank below 3 leave rounding noise as the last pivot, so an exact 0 is not enough to find them.
void require_regular(const Matrix& m, const Matrix& inverse) {
  if (!all_finite(inverse)) throw bad_transform("transform is singular; its inverse overflows");
  double norm = 0, inverse_norm = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      norm = std::max(norm, std::abs(m[i][j]));
      inverse_norm = std::max(inverse_norm, std::abs(inverse[i][j]));
    }
  if (norm * inverse_norm > 1e14) throw bad_transform("transform is singular; its axes lie in a plane or on a line");
}

Vec3d apply(const Matrix& m, Vec3 p, double w) {
  return {m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3] * w,
          m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3] * w,
          m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3] * w};
}

float round_down(double v) {
  const float f = static_cast<float>(v);
  return f > v ? std::nextafter(f, -kInfinity) : f;
}

float round_up(double v) {
  const float f = static_cast<float>(v);
  return f < v ? std::nextafter(f, kInfinity) : f;
}

}  // namespace

Transform::Transform() : m_(kIdentity), inverse_(kIdentity) {}

Transform::Transform(const Matrix& m) {
  if (!all_finite(m)) throw bad_transform("transform is not finite; replace its NaN or infinite elements");
  m_ = affine(m);
  inverse_ = inverse_of(m_);
  require_regular(m_, inverse_);
}

Transform Transform::translate(double x, double y, double z) {
  Matrix m = kIdentity, inverse = kIdentity;
  m[0][3] = x, m[1][3] = y, m[2][3] = z;
  if (!all_finite(m)) throw bad_transform("translation is not finite");
  inverse[0][3] = -x, inverse[1][3] = -y, inverse[2][3] = -z;
  return Transform(m, inverse);
}

Transform Transform::scale(double x, double y, double z) {
  Matrix m = kIdentity, inverse = kIdentity;
  m[0][0] = x, m[1][1] = y, m[2][2] = z;
  for (const double factor : {x, y, z})
    if (factor == 0 || !std::isfinite(factor) || !std::isfinite(1 / factor))
      throw bad_transform("transform is singular; every scale factor must be finite and not 0");
  inverse[0][0] = 1 / x, inverse[1][1] = 1 / y, inverse[2][2] = 1 / z;
  return Transform(m, inverse);
}

Transform Transform::rotate(double degrees, double x, double y, double z) {
  const Vec3d axis{x, y, z};
  if (!(length(axis) > 0) || !std::isfinite(length(axis)) || !std::isfinite(degrees))
    throw bad_transform("rotation has no axis; give an axis that is finite and not 0 0 0");
  // Rodrigues' formula: cos I + (1 - cos) a a^T + sin [a]x.
  const Vec3d a = normalize(axis);
  const double radians = std::remainder(degrees, 360.0) * 3.14159265358979323846 / 180;
  const double s = std::sin(radians), c = std::cos(radians), t = 1 - c;
  const Matrix m{{{t * a.x * a.x + c, t * a.x * a.y - s * a.z, t * a.x * a.z + s * a.y, 0},
                  {t * a.x * a.y + s * a.z, t * a.y * a.y + c, t * a.y * a.z - s * a.x, 0},
                  {t * a.x * a.z - s * a.y, t * a.y * a.z + s * a.x, t * a.z * a.z + c, 0},
                  {0, 0, 0, 1}}};
  Matrix inverse = m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse[i][j] = m[j][i];
  return Transform(m, inverse);
}

Transform Transform::look_at(Vec3 eye, Vec3 look, Vec3 up) {
  const Vec3d forward = Vec3d(look) - Vec3d(eye), upward(up);
  const Vec3d side = cross(upward, forward);
  if (!(length(side) > 1e-10 * length(forward) * length(upward)))
    throw bad_transform("LookAt has no unique view; eye and target must differ, and up must not point along the view");
  const Vec3d z = normalize(forward), x = normalize(side), y = cross(z, x);
  const Matrix to_world{{{x.x, y.x, z.x, eye.x}, {x.y, y.y, z.y, eye.y}, {x.z, y.z, z.z, eye.z}, {0, 0, 0, 1}}};
  if (!all_finite(to_world)) throw bad_transform("LookAt is not finite");
  return Transform(inverse_of(to_world), to_world);
}

Vec3 Transform::point(Vec3 p) const { return to_vec3(apply(m_, p, 1)); }

Vec3 Transform::vector(Vec3 v) const { return to_vec3(apply(m_, v, 0)); }

Vec3 Transform::normal(Vec3 n) const {
  const Matrix& i = inverse_;
  return to_vec3({i[0][0] * n.x + i[1][0] * n.y + i[2][0] * n.z, i[0][1] * n.x + i[1][1] * n.y + i[2][1] * n.z,
                  i[0][2] * n.x + i[1][2] * n.y + i[2][2] * n.z});
}

Bounds3 Transform::bounds(const Bounds3& b) const {
  Bounds3 out;
  if (b.empty()) return out;
  // Rounded outward, so that a point of `b` never leaves the result.
  for (int i = 0; i < 8; ++i) {
    const Vec3d p = apply(m_, b.corner(i), 1);
    out.min = tyndall::min(out.min, {round_down(p.x), round_down(p.y), round_down(p.z)});
    out.max = tyndall::max(out.max, {round_up(p.x), round_up(p.y), round_up(p.z)});
  }
  return out;
}

Transform Transform::inverse() const { return Transform(inverse_, m_); }

Transform Transform::operator*(const Transform& b) const { return Transform(product(m_, b.m_), product(b.inverse_, inverse_)); }

double Transform::determinant() const {
  const Matrix& m = m_;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

bool Transform::swaps_handedness() const { return determinant() < 0; }

bool Transform::is_identity() const { return m_ == kIdentity; }

}  // namespace tyndall
