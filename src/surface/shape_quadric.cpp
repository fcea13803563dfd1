#include "surface/shape_quadric.h"

#include <numbers>

namespace tyndall {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

double angle_of(double y, double x) {
  const double phi = std::atan2(y, x);
  return phi < 0 ? std::min(phi + kTwoPi, kTwoPi) : phi;
}

double sweep(float degrees) { return std::clamp(static_cast<double>(degrees), 0.0, 360.0) * (std::numbers::pi / 180); }

/// The corners of a regular polygon around a circle.
template <std::size_t N>
std::array<std::array<double, 2>, N> polygon_around(double radius) {
  std::array<std::array<double, 2>, N> corners;
  const double r = radius / std::cos(std::numbers::pi / N);
  for (std::size_t i = 0; i < N; ++i) {
    const double phi = kTwoPi * static_cast<double>(i) / N;
    corners[i] = {r * std::cos(phi), r * std::sin(phi)};
  }
  return corners;
}

void require(bool good, const Shape& shape, const char* what) {
  if (!good) throw Error(shape.where, what);
}

}  // namespace

PlacedQuadric::PlacedQuadric(const Shape& shape) : map_(shape.to_world), to_space_(shape.to_world) {
  flip_ = shape.reverse_orientation != shape.to_world.swaps_handedness();
  if (const auto* s = std::get_if<Sphere>(&shape.kind)) {
    kind_ = Kind::sphere;
    radius_ = s->radius;
    z_min_ = std::clamp<double>(std::min(s->z_min, s->z_max), -radius_, std::max(radius_, -radius_));
    z_max_ = std::clamp<double>(std::max(s->z_min, s->z_max), -radius_, std::max(radius_, -radius_));
    phi_max_ = sweep(s->phi_max_degrees);
  } else if (const auto* c = std::get_if<Cylinder>(&shape.kind)) {
    kind_ = Kind::cylinder;
    radius_ = c->radius;
    z_min_ = std::min(c->z_min, c->z_max);
    z_max_ = std::max(c->z_min, c->z_max);
    phi_max_ = sweep(c->phi_max_degrees);
  } else {
    const Disk& d = std::get<Disk>(shape.kind);
    kind_ = Kind::disk;
    radius_ = d.radius;
    inner_radius_ = d.inner_radius;
    z_min_ = z_max_ = d.height;
    phi_max_ = sweep(d.phi_max_degrees);
  }
  require(radius_ > 0 && std::isfinite(radius_), shape, "the radius must be positive and finite; correct \"radius\"");
  require(std::isfinite(z_min_) && std::isfinite(z_max_) && inner_radius_ >= 0, shape,
          "a size of the shape is not a finite number; correct its parameters");
  require(phi_max_ > 0, shape, "phimax must be above 0; give it in degrees, up to 360");
}

bool PlacedQuadric::keeps(double phi, double z, double radius) const {
  if (phi > phi_max_) return false;
  switch (kind_) {
    case Kind::sphere:
      return (z >= z_min_ || z_min_ <= -radius_) && (z <= z_max_ || z_max_ >= radius_);
    case Kind::cylinder:
      return z >= z_min_ && z <= z_max_;
    case Kind::disk:
      return radius <= radius_ && radius >= inner_radius_;
  }
  return false;
}

/// Angles take longer than all the rest, and rays toward emitters end before them.
void PlacedQuadric::push_root(ShapeRoots& roots, const ShapeRay& local, double t, int facing) const {
  const auto rounded = static_cast<float>(t);
  if (rounded < local.t_min || rounded > local.t_max) return;
  const Vec3d p = local.o + local.d * t;
  const double phi = angle_of(p.y, p.x);
  const double rho = std::sqrt(p.x * p.x + p.y * p.y);
  if (!keeps(phi, p.z, rho)) return;
  const Vec3d n = kind_ == Kind::disk ? Vec3d(0, 0, 1) : Vec3d(p.x, p.y, kind_ == Kind::sphere ? p.z : 0);
  const double cosine = std::abs(dot(n, local.d)) / (length(n) * length(local.d));
  const double v = kind_ == Kind::sphere ? std::atan2(rho, p.z) : (kind_ == Kind::disk ? rho : p.z);
  roots.push({t, facing, cosine, phi, v});
}

// |o + t d|^2 = r^2, over xyz for a sphere and over xy for a cylinder. The discriminant is taken at the ray's point
// nearest to the centre or axis, as (r - l)(r + l), which does not cancel for small or distant shapes [pbrt-v4, 6.8.2].
ShapeRoots PlacedQuadric::intersect(const ShapeRay& ray) const {
  const ShapeRay local{map_.inverse_point(ray.o), map_.inverse_vector(ray.d), ray.t_min, ray.t_max};
  ShapeRoots roots;
  if (kind_ == Kind::disk) {
    if (local.d.z != 0) push_root(roots, local, (z_min_ - local.o.z) / local.d.z, local.d.z > 0 ? 1 : -1);
    return roots;
  }
  const double along_z = kind_ == Kind::sphere ? 1 : 0;
  const Vec3d d(local.d.x, local.d.y, local.d.z * along_z), o(local.o.x, local.o.y, local.o.z * along_z);
  const double a = dot(d, d);
  if (!(a > 0)) return roots;
  const double t_near = -dot(o, d) / a;
  const double l = length(o + d * t_near);
  const double discriminant = (radius_ - l) * (radius_ + l);
  if (!(discriminant > 0)) return roots;
  const double half_chord = std::sqrt(discriminant / a);
  push_root(roots, local, t_near - half_chord, -1);
  push_root(roots, local, t_near + half_chord, 1);
  return roots;
}

ShapeSurface PlacedQuadric::surface(double phi, double v) const {
  const double c = std::cos(phi), s = std::sin(phi);
  Vec3d p, n;
  Vec2 uv{static_cast<float>(phi / phi_max_), 0};
  double rho = radius_;
  if (kind_ == Kind::sphere) {
    rho = radius_ * std::sin(v);
    p = {rho * c, rho * s, radius_ * std::cos(v)};
    n = p;
    const double theta_min = std::acos(z_min_ / radius_), theta_max = std::acos(z_max_ / radius_);
    uv.y = static_cast<float>((v - theta_min) / (theta_max - theta_min));
  } else if (kind_ == Kind::cylinder) {
    p = {radius_ * c, radius_ * s, v};
    n = {p.x, p.y, 0};
    uv.y = static_cast<float>((v - z_min_) / (z_max_ - z_min_));
  } else {
    rho = v;
    p = {v * c, v * s, z_min_};
    n = {0, 0, 1};
    uv.y = static_cast<float>((radius_ - v) / (radius_ - inner_radius_));
  }
  const double arm = phi_max_ * std::max(rho, 1e-5 * radius_);  // a tangent at poles too, as pbrt's
  ShapeSurface surface;
  surface.p = map_.point(p);
  surface.ng = surface.ns = normalize(map_.normal(n)) * orientation();
  surface.dpdu = map_.vector({-s * arm, c * arm, 0});
  surface.uv = uv;
  surface.error = 1e-14 * (max_component(abs(surface.p)) + length(surface.p - map_.point({0, 0, 0})));
  return surface;
}

ShapeTangents PlacedQuadric::tangents(double phi, double v) const {
  const double c = std::cos(phi), s = std::sin(phi);
  const double rho = kind_ == Kind::sphere ? radius_ * std::sin(v) : kind_ == Kind::disk ? v : radius_;
  const double arm = phi_max_ * std::max(rho, 1e-5 * radius_);
  const Vec3d dpdu{-s * arm, c * arm, 0};
  Vec3d dpdv, dndu, dndv;  // the normal of round shapes is the outward one, whichever way the shape faces, as in pbrt
  if (kind_ == Kind::sphere) {
    const double span = std::acos(z_max_ / radius_) - std::acos(z_min_ / radius_), z = radius_ * std::cos(v);
    dpdv = Vec3d{z * c, z * s, -rho} * span;
    dndu = dpdu * (1 / radius_), dndv = dpdv * (1 / radius_);
  } else if (kind_ == Kind::cylinder) {
    dpdv = {0, 0, z_max_ - z_min_};
    dndu = dpdu * (1 / radius_);
  } else {
    dpdv = Vec3d{c, s, 0} * (inner_radius_ - radius_);
  }
  ShapeTangents t;
  t.dpdu = t.shading_dpdu = map_.vector(dpdu);
  t.dpdv = t.shading_dpdv = map_.vector(dpdv);
  t.dndu = map_.normal(dndu);
  t.dndv = map_.normal(dndv);
  return t;
}

Bounds3 PlacedQuadric::bounds() const {
  const float r = static_cast<float>(radius_);
  return to_space_.bounds({{-r, -r, static_cast<float>(z_min_)}, {r, r, static_cast<float>(z_max_)}});
}

/// The corners of a polygon around the circle in which a cone from the eye touches the sphere.
ShapeOutline PlacedQuadric::outline_of_sphere(const ShapeView& local) const {
  const double distance = length(local.from);
  if (!local.along && !(distance > radius_)) return {};
  const double sine = local.along ? 0 : radius_ / distance;
  const Vec3d axis = normalize(local.from), center = axis * (radius_ * sine);
  const Vec3d across = normalize(std::abs(axis.z) < 0.5 ? Vec3d(axis.y, -axis.x, 0) : Vec3d(0, axis.z, -axis.y));
  const Vec3d up = cross(axis, across);
  ShapeOutline points;
  for (const auto [x, y] : polygon_around<12>(radius_ * std::sqrt((1 - sine) * (1 + sine))))
    points.push_back(map_.point(center + across * x + up * y));
  return points;
}

ShapeOutline PlacedQuadric::outline(const ShapeView& view) const {
  if (kind_ == Kind::sphere) {
    return outline_of_sphere({view.along ? map_.inverse_vector(view.from) : map_.inverse_point(view.from), view.along});
  }
  ShapeOutline points;
  for (const auto [x, y] : polygon_around<8>(radius_)) {
    points.push_back(map_.point({x, y, z_min_}));
    if (kind_ == Kind::cylinder) points.push_back(map_.point({x, y, z_max_}));
  }
  return points;
}

Enclosure PlacedQuadric::enclosure(Vec3d center) const {
  constexpr int kAround = 12, kAlong = 6;
  if (kind_ == Kind::sphere && phi_max_ >= kTwoPi && z_min_ <= -radius_ && z_max_ >= radius_) {
    const double determinant = dot(cross(map_.vector({1, 0, 0}), map_.vector({0, 1, 0})), map_.vector({0, 0, 1}));
    const double volume = kTwoPi * 2 / 3 * radius_ * radius_ * radius_ * std::abs(determinant);
    return {.volume = orientation() * volume, .vector_area = {}, .area = std::cbrt(volume * volume)};  // of this size
  }
  const double low = kind_ == Kind::sphere ? std::acos(z_max_ / radius_) : kind_ == Kind::disk ? inner_radius_ : z_min_;
  const double high = kind_ == Kind::sphere ? std::acos(z_min_ / radius_) : kind_ == Kind::disk ? radius_ : z_max_;
  // A full turn ends exactly where it began.
  const bool full = phi_max_ >= kTwoPi;
  const auto at = [&](int i, int j) {
    return surface(full && i == kAround ? 0 : phi_max_ * i / kAround, low + (high - low) * j / kAlong).p - center;
  };
  Enclosure e;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAlong; ++j) {
      const Vec3d a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const Vec3d ng = surface(phi_max_ * (i + 0.5) / kAround, low + (high - low) * (j + 0.5) / kAlong).ng;
      const int side = dot(cross(c - a, d - b), ng) < 0 ? -1 : 1;
      e.add_triangle(a, b, c, side);
      e.add_triangle(a, c, d, side);
    }
  }
  return e;
}

}  // namespace tyndall
