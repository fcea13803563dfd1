#include "surface/shape_exact.h"

namespace tyndall {
namespace {

/// An unevaluated sum of two doubles: about 106 bits [Dekker 1971].
struct TwoDoubles {
  double high = 0, low = 0;
};

TwoDoubles two_sum(double a, double b) {
  const double s = a + b;
  const double bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

TwoDoubles two_product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

TwoDoubles add(TwoDoubles a, TwoDoubles b) {
  const TwoDoubles s = two_sum(a.high, b.high);
  const TwoDoubles t = two_sum(a.low, b.low);
  const TwoDoubles v = two_sum(s.high, s.low + t.high);
  return two_sum(v.high, v.low + t.low);
}

TwoDoubles multiply(TwoDoubles a, double b) {
  const TwoDoubles p = two_product(a.high, b);
  return two_sum(p.high, p.low + a.low * b);
}

TwoDoubles minor(double a, double b, double c, double d) {  // a b - c d
  const TwoDoubles cd = two_product(c, d);
  return add(two_product(a, b), {-cd.high, -cd.low});
}

double precise_determinant(Vec3d a, Vec3d b, Vec3d d) {
  const TwoDoubles x = multiply(minor(a.y, b.z, a.z, b.y), d.x);
  const TwoDoubles y = multiply(minor(a.z, b.x, a.x, b.z), d.y);
  const TwoDoubles z = multiply(minor(a.x, b.y, a.y, b.x), d.z);
  const TwoDoubles sum = add(add(x, y), z);
  return sum.high != 0 ? sum.high : sum.low;
}

int sign_of(double v) { return (v > 0) - (v < 0); }

}  // namespace

// Each step negates exactly when a and b change places, so the two triangles beside an edge compute the same bits.
EdgeSide edge_side(const ShapeRay& ray, Vec3d a, Vec3d b) {
  const Vec3d oa = a - ray.o, ob = b - ray.o;
  double value = dot(cross(oa, ob), ray.d);
  const Vec3d aa = abs(oa), bb = abs(ob), dd = abs(ray.d);
  const double permanent =
      (aa.y * bb.z + aa.z * bb.y) * dd.x + (aa.z * bb.x + aa.x * bb.z) * dd.y + (aa.x * bb.y + aa.y * bb.x) * dd.z;
  if (std::abs(value) <= 1e-15 * permanent) value = precise_determinant(oa, ob, ray.d);
  if (value != 0) return {sign_of(value), std::abs(value)};

  // Derivative of the determinant as the ray moves along x, then y, then z.
  const Vec3d slope = cross(ray.d, b - a);
  for (const double s : {slope.x, slope.y, slope.z}) {
    if (s != 0) return {sign_of(s), 0};
  }
  return {0, 0};
}

}  // namespace tyndall
