#include "math/frame.h"
#include "surface/shape_exact.h"
#include "surface/shape_mesh.h"

namespace tyndall {

// The three edge functions of one line have one sign exactly when it passes through the triangle; they are also the
// weights of the opposite vertices, up to their sum [Shevtsov et al. 2007]. t is interpolated with them, not divided by
// the plane's slope, so it stays between the vertices however grazing the ray.
std::optional<ShapeRoot> intersect_triangle(const ShapeRay& ray, const std::array<Vec3d, 3>& abc) {
  const auto& [a, b, c] = abc;
  const EdgeSide ab = edge_side(ray, a, b);
  const EdgeSide bc = edge_side(ray, b, c);
  if (ab.sign == 0 || ab.sign != bc.sign) return {};
  const EdgeSide ca = edge_side(ray, c, a);
  if (ab.sign != ca.sign) return {};

  const double sum = ab.value + bc.value + ca.value;
  if (!(sum > 0)) return {};
  const double w0 = bc.value / sum, w1 = ca.value / sum, w2 = ab.value / sum;
  const Vec3d point = (a - ray.o) * w0 + (b - ray.o) * w1 + (c - ray.o) * w2;
  const double d2 = dot(ray.d, ray.d);
  const double area = length(cross(b - a, c - a));
  return ShapeRoot{
      .t = dot(point, ray.d) / d2, .facing = ab.sign, .cosine = std::min(1.0, sum / (area * std::sqrt(d2))), .u = w1, .v = w2};
}

namespace {

std::array<Vec2, 3> texture_coordinates(const PlacedMesh& mesh, const std::array<std::uint32_t, 3>& corner) {
  std::array<Vec2, 3> uv{Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}};
  for (std::size_t i = 0; i < 3 && !mesh.uvs->empty(); ++i) uv[i] = (*mesh.uvs)[corner[i]];
  return uv;
}

/// The two partial derivatives of what is linear over a triangle, from its differences to corner 2.
struct Linear {
  explicit Linear(const std::array<Vec2, 3>& uv)
      : du02(double(uv[0].x) - uv[2].x),
        dv02(double(uv[0].y) - uv[2].y),
        du12(double(uv[1].x) - uv[2].x),
        dv12(double(uv[1].y) - uv[2].y),
        determinant(du02 * dv12 - dv02 * du12) {}

  bool degenerate() const { return !(std::abs(determinant) >= 1e-9); }  // pbrt's threshold
  Vec3d along_u(Vec3d d02, Vec3d d12) const { return (d02 * dv12 - d12 * dv02) * (1 / determinant); }
  Vec3d along_v(Vec3d d02, Vec3d d12) const { return (d12 * du02 - d02 * du12) * (1 / determinant); }

  double du02, dv02, du12, dv12, determinant;
};

/// dp/du, where triangles without one have any direction in their plane.
Vec3d tangent_of(const std::array<Vec3d, 3>& v, const Linear& linear) {
  const Vec3d dp02 = v[0] - v[2], dp12 = v[1] - v[2], dpdu = linear.degenerate() ? Vec3d() : linear.along_u(dp02, dp12);
  return dot(dpdu, dpdu) > 0 ? dpdu : Vec3d(Frame::around(to_vec3(normalize(cross(dp02, dp12)))).x);
}

/// How far off the plane the ray tracer's single-precision test may put a point of the triangle: a few roundings of
/// the vertices relative to the ray's origin, and the tilt of a thin triangle's normal.
double test_error(Vec3d p, const std::array<Vec3d, 3>& v, double doubled_area) {
  double reach2 = 0;
  for (const Vec3d& vertex : v) reach2 = std::max(reach2, dot(vertex - p, vertex - p));
  const double thinness = doubled_area > 0 ? std::min(reach2 / doubled_area, 1e3) : 1e3;
  return 0x1p-22 * std::sqrt(reach2) * (1 + thinness);
}

}  // namespace

ShapeSurface triangle_surface(const PlacedMesh& mesh, std::uint32_t primitive, double b1, double b2) {
  const auto corner = mesh.corners<3>(primitive);
  const std::array<double, 3> w{1 - b1 - b2, b1, b2};
  const std::array<Vec3d, 3> v{mesh.position(corner[0]), mesh.position(corner[1]), mesh.position(corner[2])};
  const Vec3d winding = cross(v[0] - v[2], v[1] - v[2]);

  ShapeSurface surface;
  surface.p = v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
  surface.ng = surface.ns = normalize(winding) * (mesh.flip ? -1 : 1);
  const std::array<Vec2, 3> uv = texture_coordinates(mesh, corner);
  surface.uv = {static_cast<float>(w[0] * uv[0].x + w[1] * uv[1].x + w[2] * uv[2].x),
                static_cast<float>(w[0] * uv[0].y + w[1] * uv[1].y + w[2] * uv[2].y)};
  surface.dpdu = tangent_of(v, Linear(uv));
  surface.error = test_error(surface.p, v, length(winding));
  if (mesh.normals.empty()) return surface;

  // Vertex normals bend the shading normal and decide the side, as pbrt's authoritative orientation.
  const auto normal = [&](std::size_t i) { return Vec3d(mesh.normals[corner[i]]); };
  const Vec3d ns = normal(0) * w[0] + normal(1) * w[1] + normal(2) * w[2];
  if (dot(ns, ns) > 0) surface.ns = normalize(ns);
  if (dot(surface.ng, surface.ns) < 0) surface.ng = -surface.ng;
  const Vec3d bitangent = cross(surface.ns, surface.dpdu);
  surface.dpdu = dot(bitangent, bitangent) > 0 ? cross(bitangent, surface.ns) : Vec3d(Frame::around(to_vec3(surface.ns)).x);
  return surface;
}

ShapeTangents triangle_tangents(const PlacedMesh& mesh, std::uint32_t primitive, double b1, double b2) {
  const auto corner = mesh.corners<3>(primitive);
  const Vec3d p2 = mesh.position(corner[2]);
  const Vec3d dp02 = mesh.position(corner[0]) - p2, dp12 = mesh.position(corner[1]) - p2;
  const Linear linear(texture_coordinates(mesh, corner));
  const Vec3d ng = normalize(cross(dp02, dp12));

  ShapeTangents t;
  if (!linear.degenerate()) t.dpdu = linear.along_u(dp02, dp12), t.dpdv = linear.along_v(dp02, dp12);
  const Vec3d across = cross(t.dpdu, t.dpdv);
  if (!(dot(across, across) > 0)) {
    const Frame frame = Frame::around(to_vec3(ng));
    t.dpdu = Vec3d(frame.x), t.dpdv = Vec3d(frame.y);
  }
  t.shading_dpdu = t.dpdu, t.shading_dpdv = t.dpdv;
  if (mesh.normals.empty()) return t;

  const auto normal = [&](std::size_t i) { return Vec3d(mesh.normals[corner[i]]); };
  const Vec3d ns = triangle_surface(mesh, primitive, b1, b2).ns;
  const Vec3d bitangent = cross(ns, t.dpdu);
  if (dot(bitangent, bitangent) > 0) t.shading_dpdu = cross(bitangent, ns), t.shading_dpdv = bitangent;
  if (!linear.degenerate()) {
    t.dndu = linear.along_u(normal(0) - normal(2), normal(1) - normal(2));
    t.dndv = linear.along_v(normal(0) - normal(2), normal(1) - normal(2));
  }
  return t;
}

}  // namespace tyndall
