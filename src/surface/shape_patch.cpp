#include "math/frame.h"
#include "surface/shape_exact.h"
#include "surface/shape_mesh.h"

namespace tyndall {
namespace {

using Corners = std::array<Vec3d, 4>;  // p00 p10 p01 p11

Vec3d lerp(double t, Vec3d a, Vec3d b) { return a * (1 - t) + b * t; }
Vec3d point_at(const Corners& p, double u, double v) { return lerp(u, lerp(v, p[0], p[2]), lerp(v, p[1], p[3])); }
Vec3d dpdu_at(const Corners& p, double v) { return lerp(v, p[1], p[3]) - lerp(v, p[0], p[2]); }
Vec3d dpdv_at(const Corners& p, double u) { return lerp(u, p[2], p[3]) - lerp(u, p[0], p[1]); }

struct PatchRoot {
  ShapeRoot root;
  double inset;  ///< how far inside the unit square (u, v) is; negative outside
};

/// The ray meets the line p(u, .) of the patch; where is v, and when?
std::optional<PatchRoot> root_on_line(const ShapeRay& ray, const Corners& q, double u) {
  constexpr double kSlack = 1e-7;  // what lies on the outline is decided by its winding, not here
  if (!(u >= -kSlack && u <= 1 + kSlack)) return {};
  const Vec3d start = lerp(u, q[0], q[1]), along = dpdv_at(q, u);
  const Vec3d n = cross(ray.d, along);
  const double n2 = dot(n, n);
  if (!(n2 > 0)) return {};
  const Vec3d m = cross(n, start);
  const double v = dot(m, ray.d) / n2;
  if (!(v >= -kSlack && v <= 1 + kSlack)) return {};
  const double inset = std::min({u, 1 - u, v, 1 - v});
  const double cu = std::clamp(u, 0.0, 1.0), cv = std::clamp(v, 0.0, 1.0);
  const Vec3d ng = cross(dpdu_at(q, cv), dpdv_at(q, cu));
  const double side = dot(ng, ray.d);
  const double cosine = std::abs(side) / std::max(1e-300, length(ng) * length(ray.d));
  return PatchRoot{{dot(m, along) / n2, side > 0 ? 1 : -1, cosine, cu, cv}, inset};
}

/// How often the patch's outline winds around the ray: the sum of `facing` over all its meetings.
int outline_winding(const ShapeRay& ray, const Corners& p) {
  const auto lower = intersect_triangle(ray, {p[0], p[1], p[3]});
  const auto upper = intersect_triangle(ray, {p[0], p[3], p[2]});
  return (lower ? lower->facing : 0) + (upper ? upper->facing : 0);
}

/// Roots of a + b u + c u^2 for the lines p(u, .) that meet the ray: det[d, p(u, 0) - o, dpdv(u)] = 0.
std::array<double, 2> line_parameters(const ShapeRay& ray, const Corners& q) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double a = dot(cross(q[0], ray.d), q[2] - q[0]);
  const double c = dot(cross(q[1] - q[0], q[2] - q[3]), ray.d);
  const double b = dot(cross(q[1], ray.d), q[3] - q[1]) - a - c;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return {none, none};
  const double s = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  return {c != 0 ? s / c : none, s != 0 ? a / s : none};
}

/// The patch taken as two triangles, for rays so close to its outline that the quadratic finds nothing.
ShapeRoots as_triangles(const ShapeRay& ray, const Corners& p, int facing) {
  ShapeRoots roots;
  for (const bool lower : {true, false}) {
    const auto hit = lower ? intersect_triangle(ray, {p[0], p[1], p[3]}) : intersect_triangle(ray, {p[0], p[3], p[2]});
    if (!hit || hit->facing != facing) continue;
    ShapeRoot root = *hit;
    root.u = lower ? hit->u + hit->v : hit->u;
    root.v = lower ? hit->v : hit->u + hit->v;
    roots.push(root);
    return roots;
  }
  return roots;
}

}  // namespace

// Lines of constant u against the ray [Reshetov 2019, "Cool Patches", Ray Tracing Gems, ch. 8]. The number of meetings is then
// made to agree with the outline's winding, which is exact, so that neighbours that share edges neither leak nor overlap.
ShapeRoots intersect_patch(const ShapeRay& ray, const std::array<Vec3d, 4>& p) {
  const Corners q{p[0] - ray.o, p[1] - ray.o, p[2] - ray.o, p[3] - ray.o};
  std::array<PatchRoot, 2> found{};
  int count = 0;
  for (const double u : line_parameters(ray, q)) {
    if (const auto root = root_on_line(ray, q, u)) found[static_cast<std::size_t>(count++)] = *root;
  }
  const int winding = outline_winding(ray, p);
  ShapeRoots roots;
  if (winding == 0) {
    if (count < 2 || found[0].root.facing == found[1].root.facing || found[0].inset < 0 || found[1].inset < 0) return roots;
    roots.push(found[0].root);
    roots.push(found[1].root);
  } else if (count == 0) {
    roots = as_triangles(ray, p, winding > 0 ? 1 : -1);
  } else {
    const bool second = count == 2 && found[1].inset > found[0].inset;
    ShapeRoot root = found[second ? 1 : 0].root;
    root.facing = winding > 0 ? 1 : -1;
    roots.push(root);
  }
  return roots;
}

namespace {

std::array<Vec2, 4> texture_coordinates(const PlacedMesh& mesh, const std::array<std::uint32_t, 4>& corner) {
  std::array<Vec2, 4> st;
  for (std::size_t i = 0; i < 4; ++i) st[i] = (*mesh.uvs)[corner[i]];
  return st;
}

/// Derivatives with respect to the texture coordinates (s, t) from those by the patch's own (u, v).
class Reparametrized {
 public:
  Reparametrized(const std::array<Vec2, 4>& st, double u, double v) {
    const auto fu = static_cast<float>(u), fv = static_cast<float>(v);
    const Vec2 du = (st[1] * (1 - fv) + st[3] * fv) - (st[0] * (1 - fv) + st[2] * fv);
    const Vec2 dv = (st[2] * (1 - fu) + st[3] * fu) - (st[0] * (1 - fu) + st[1] * fu);
    const auto inverse = [](float x) { return std::abs(x) < 1e-8f ? 0.0 : 1.0 / x; };  // pbrt's rule
    duds_ = inverse(du.x), dvds_ = inverse(dv.x), dudt_ = inverse(du.y), dvdt_ = inverse(dv.y);
  }

  void apply(Vec3d& du, Vec3d& dv) const {
    const Vec3d ds = du * duds_ + dv * dvds_, dt = du * dudt_ + dv * dvdt_;
    du = ds, dv = dt;
  }

 private:
  double duds_, dvds_, dudt_, dvdt_;
};

/// `v` turned by the rotation that takes unit `from` to unit `to`; opposite ones share their plane.
Vec3d turn(Vec3d v, Vec3d from, Vec3d to) {
  if (dot(from, to) < -0.9999) from = -from;
  const Vec3d axis = cross(from, to);
  const Vec3d turned = v + cross(axis, v) + cross(axis, cross(axis, v)) * (1 / (1 + dot(from, to)));
  return turned - to * dot(turned, to);
}

}  // namespace

ShapeSurface patch_surface(const PlacedMesh& mesh, std::uint32_t primitive, double u, double v) {
  const auto corner = mesh.corners<4>(primitive);
  const Corners p{mesh.position(corner[0]), mesh.position(corner[1]), mesh.position(corner[2]), mesh.position(corner[3])};
  const Vec3d dpdu = dpdu_at(p, v), dpdv = dpdv_at(p, u);
  ShapeSurface surface;
  surface.p = point_at(p, u, v);
  surface.dpdu = dpdu;
  Vec3d n = normalize(cross(dpdu, dpdv));
  if (dot(n, n) == 0) n = normalize(cross(p[3] - p[0], p[2] - p[1]));  // at a corner where two vertices coincide
  surface.ng = surface.ns = n * (mesh.flip ? -1 : 1);
  surface.uv = {static_cast<float>(u), static_cast<float>(v)};
  surface.error = 1e-13 * (max_component(abs(surface.p)) + length(p[3] - p[0]) + length(p[2] - p[1]));

  if (!mesh.uvs->empty()) {
    const std::array<Vec2, 4> st = texture_coordinates(mesh, corner);
    Vec3d dpds = dpdu, dpdt = dpdv;
    Reparametrized(st, u, v).apply(dpds, dpdt);
    const Vec3d across = cross(dpds, dpdt);
    if (dot(across, across) > 0) surface.dpdu = dpds;
    const float fu = surface.uv.x, fv = surface.uv.y;
    surface.uv = (st[0] * (1 - fv) + st[2] * fv) * (1 - fu) + (st[1] * (1 - fv) + st[3] * fv) * fu;
  }
  if (!mesh.normals.empty()) {
    const auto normal = [&](std::size_t i) { return Vec3d(mesh.normals[corner[i]]); };
    const Vec3d ns = lerp(u, lerp(v, normal(0), normal(2)), lerp(v, normal(1), normal(3)));
    if (dot(ns, ns) > 0) {
      surface.ns = normalize(ns);
      surface.dpdu = turn(surface.dpdu, surface.ng, surface.ns);
      if (dot(surface.ng, surface.ns) < 0) surface.ng = -surface.ng;
    }
  }
  if (!(dot(surface.dpdu, surface.dpdu) > 0)) surface.dpdu = Vec3d(Frame::around(to_vec3(surface.ns)).x);
  return surface;
}

namespace {

/// Weingarten's equations for a bilinear patch, whose only second derivative is the mixed one `d2p`.
std::array<Vec3d, 2> normal_derivatives(Vec3d dpdu, Vec3d dpdv, Vec3d d2p) {
  const double E = dot(dpdu, dpdu), F = dot(dpdu, dpdv), G = dot(dpdv, dpdv);
  const double f = dot(normalize(cross(dpdu, dpdv)), d2p), det = E * G - F * F;
  if (!(det > 0)) return {};
  return {(dpdu * (f * F) - dpdv * (f * E)) * (1 / det), (dpdv * (f * F) - dpdu * (f * G)) * (1 / det)};
}

}  // namespace

ShapeTangents patch_tangents(const PlacedMesh& mesh, std::uint32_t primitive, double u, double v) {
  const auto corner = mesh.corners<4>(primitive);
  const Corners p{mesh.position(corner[0]), mesh.position(corner[1]), mesh.position(corner[2]), mesh.position(corner[3])};
  ShapeTangents t;
  t.dpdu = dpdu_at(p, v), t.dpdv = dpdv_at(p, u);
  auto [normal_du, normal_dv] = normal_derivatives(t.dpdu, t.dpdv, (p[0] - p[1]) + (p[3] - p[2]));
  if (!mesh.normals.empty()) {
    const auto normal = [&](std::size_t i) { return Vec3d(mesh.normals[corner[i]]); };
    normal_du = lerp(v, normal(1), normal(3)) - lerp(v, normal(0), normal(2));
    normal_dv = lerp(u, normal(2), normal(3)) - lerp(u, normal(0), normal(1));
  }
  if (!mesh.uvs->empty()) {
    const Reparametrized by_st(texture_coordinates(mesh, corner), u, v);
    Vec3d dpds = t.dpdu, dpdt = t.dpdv;
    by_st.apply(dpds, dpdt);
    const Vec3d n = cross(dpds, dpdt);
    if (dot(n, n) > 0) {
      if (dot(cross(t.dpdu, t.dpdv), n) < 0) dpdt = -dpdt;
      t.dpdu = dpds, t.dpdv = dpdt;
    }
    by_st.apply(normal_du, normal_dv);
  }
  t.dndu = normal_du, t.dndv = normal_dv;
  t.shading_dpdu = t.dpdu, t.shading_dpdv = t.dpdv;
  if (!mesh.normals.empty()) {
    const ShapeSurface s = patch_surface(mesh, primitive, u, v);
    t.shading_dpdu = turn(t.dpdu, s.ng, s.ns), t.shading_dpdv = turn(t.dpdv, s.ng, s.ns);
  }
  return t;
}

}  // namespace tyndall
