#include "light/quadric_emitter.h"

#include <numbers>

#include "math/frame.h"
#include "math/similarity.h"
#include "math/spherical.h"
#include "math/warp.h"

namespace tyndall {
namespace {

constexpr double kTau = 2 * std::numbers::pi;

Vec3d column(const Transform::Matrix& m, int j) { return {m[0][j], m[1][j], m[2][j]}; }

Vec3d apply(const Transform::Matrix& m, Vec3d p) {
  return column(m, 0) * p.x + column(m, 1) * p.y + column(m, 2) * p.z + column(m, 3);
}

}  // namespace

QuadricEmitter::QuadricEmitter(const Shape& shape, const Transform& to_world, bool opaque)
    : map_(to_world.matrix()), inverse_(to_world.inverse().matrix()) {
  determinant_ = std::abs(dot(column(map_, 0), cross(column(map_, 1), column(map_, 2))));
  // As the geometry orients it: the flip comes from the shape's own transform, an instance's carries the normal along.
  sign_ = shape.reverse_orientation != shape.to_world.swaps_handedness() ? -1 : 1;
  float phi_degrees = 360;
  if (const auto* s = std::get_if<Sphere>(&shape.kind)) {
    kind_ = Kind::sphere;
    radius_ = s->radius;
    z_min_ = std::clamp<double>(std::min(s->z_min, s->z_max), -radius_, radius_);
    z_max_ = std::clamp<double>(std::max(s->z_min, s->z_max), -radius_, radius_);
    phi_degrees = s->phi_max_degrees;
  } else if (const auto* c = std::get_if<Cylinder>(&shape.kind)) {
    kind_ = Kind::cylinder;
    radius_ = c->radius;
    z_min_ = std::min(c->z_min, c->z_max);
    z_max_ = std::max(c->z_min, c->z_max);
    phi_degrees = c->phi_max_degrees;
  } else {
    const Disk& d = std::get<Disk>(shape.kind);
    kind_ = Kind::disk;
    radius_ = d.radius;
    inner_radius_ = std::min(d.inner_radius, d.radius);
    z_min_ = z_max_ = d.height;
    phi_degrees = d.phi_max_degrees;
  }
  phi_max_ = std::clamp<double>(phi_degrees, 0, 360) * (kTau / 360);

  object_area_ = kind_ == Kind::disk ? 0.5 * phi_max_ * (radius_ - inner_radius_) * (radius_ + inner_radius_)
                                     : phi_max_ * radius_ * (z_max_ - z_min_);
  const std::optional<double> scale = similarity_scale(map_);
  area_ = scale ? object_area_ * *scale * *scale : measure_area();
  projected_area_ = kind_ == Kind::disk ? area_ : (kind_ == Kind::sphere ? area_ / 4 : area_ / std::numbers::pi);
  const bool whole = kind_ == Kind::sphere && z_min_ <= -radius_ && z_max_ >= radius_ && phi_max_ >= kTau;
  if (scale && whole && opaque) cone_radius_ = *scale * radius_;

  // A sphere's box is tighter around its centre than as the transformed box of its object space.
  const auto r = static_cast<float>(radius_);
  if (scale && kind_ == Kind::sphere) {
    const double reach = *scale * radius_ * (1 + 1e-6);
    const Vec3d c = this->to_world({0, 0, 0});
    box_.expand(to_vec3(c - Vec3d(reach, reach, reach)));
    box_.expand(to_vec3(c + Vec3d(reach, reach, reach)));
  } else {
    box_ = to_world.bounds({{-r, -r, static_cast<float>(z_min_)}, {r, r, static_cast<float>(z_max_)}});
  }
}

Vec3d QuadricEmitter::to_world(Vec3d p) const { return apply(map_, p); }
Vec3d QuadricEmitter::to_object(Vec3d p) const { return apply(inverse_, p); }
Vec3d QuadricEmitter::world_normal(Vec3d n) const {
  return Vec3d(dot(column(inverse_, 0), n), dot(column(inverse_, 1), n), dot(column(inverse_, 2), n)) * sign_;
}

// An area element n dA maps to det(M) M^-T n dA.
double QuadricEmitter::world_area_scale(Vec3d object_n) const { return determinant_ * length(world_normal(object_n)); }

double QuadricEmitter::measure_area() const {
  if (kind_ == Kind::disk) return object_area_ * world_area_scale({0, 0, 1});
  // Mean of the area scale over the surface: the midpoint rule on a grid, exact enough for any sane ellipsoid.
  constexpr int n = 64;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += world_area_scale(object_sample({(i + 0.5f) / n, (j + 0.5f) / n}).n);
  return object_area_ * sum / (n * n);
}

EmitterExtent QuadricEmitter::extent() const {
  EmitterExtent extent{box_, DirectionCone::everything()};
  if (kind_ == Kind::disk) extent.normals = DirectionCone::around(to_vec3(normalize(world_normal({0, 0, 1}))));
  return extent;
}

LightPlace QuadricEmitter::place() const {
  LightPlace place = place_of(box_);
  if (kind_ == Kind::disk) place.normal = extent().normals.axis;
  return place;
}

// On spheres and cylinders z is uniform [Archimedes], on disks the squared radius.
QuadricEmitter::ObjectPoint QuadricEmitter::object_sample(Vec2 u) const {
  const double phi = u.x * phi_max_;
  double z = z_min_ + u.y * (z_max_ - z_min_), rho = radius_;
  if (kind_ == Kind::disk) rho = std::sqrt((1 - u.y) * inner_radius_ * inner_radius_ + u.y * radius_ * radius_);
  if (kind_ == Kind::sphere) rho = std::sqrt(std::max(0.0, (radius_ - z) * (radius_ + z)));
  const Vec3d p(rho * std::cos(phi), rho * std::sin(phi), z);
  return {p, object_normal(p)};
}

Vec3d QuadricEmitter::object_normal(Vec3d p) const {
  if (kind_ == Kind::disk) return {0, 0, 1};
  return normalize(kind_ == Kind::sphere ? p : Vec3d(p.x, p.y, 0));
}

// pbrt's parametrisation of each shape.
Vec2 QuadricEmitter::uv(Vec3d p) const {
  double phi = std::atan2(p.y, p.x);
  if (phi < 0) phi += kTau;
  const double rho = std::hypot(p.x, p.y);
  double v = 0;
  if (kind_ == Kind::disk) v = (radius_ - rho) / (radius_ - inner_radius_);
  if (kind_ == Kind::cylinder) v = (p.z - z_min_) / (z_max_ - z_min_);
  if (kind_ == Kind::sphere) {
    const double low = std::acos(z_min_ / radius_), high = std::acos(z_max_ / radius_);
    v = (std::atan2(rho, p.z) - low) / (high - low);
  }
  return {static_cast<float>(phi / phi_max_), static_cast<float>(v)};
}

// Points of the sphere itself, some of which are rounded outward, are left to areas: from inside they would seem to lie before
// it.
std::optional<double> QuadricEmitter::cone_height(const RoundedPoint& p) const {
  if (!(cone_radius_ > 0)) return std::nullopt;
  const double distance = length(to_world({0, 0, 0}) - p.at);
  if (distance <= cone_radius_ + kRounding * p.reach) return std::nullopt;
  return sphere_cone_height(distance, cone_radius_);
}

EmitterSample QuadricEmitter::cone_sample(Vec3d to_center, double h, Vec3d p, Vec2 u) const {
  const Vec3d axis = normalize(to_center);
  const Vec3 local = square_to_uniform_cone(u, static_cast<float>(h));
  const Vec3 wi = normalize(Frame::around(to_vec3(axis)).to_world(local));

  // The nearer of the two intersections, from their product: the difference would cancel beside the surface.
  const double dc = length(to_center), sine2 = double(local.x) * local.x + double(local.y) * local.y;
  const double discriminant = std::max(0.0, cone_radius_ * cone_radius_ - dc * dc * sine2);
  const double t = (dc - cone_radius_) * (dc + cone_radius_) / (dc * local.z + std::sqrt(discriminant));
  const Vec3d outward = Vec3d(wi) * t - to_center;
  return {wi, static_cast<float>(t), to_vec3(normalize(outward) * sign_), uv(to_object(p + Vec3d(wi) * t)),
          static_cast<float>(1 / (kTau * h))};
}

std::optional<EmitterSample> QuadricEmitter::sample(const RoundedPoint& p, Vec2 u) const {
  if (const auto h = cone_height(p)) return cone_sample(to_world({0, 0, 0}) - p.at, *h, p.at, u);

  if (!(object_area_ > 0)) return std::nullopt;
  const ObjectPoint point = object_sample(u);
  const Vec3d x = to_world(point.p) - p.at, n = world_normal(point.n);
  const auto pdf = solid_angle_density(1 / (object_area_ * world_area_scale(point.n)), x, n);
  if (!pdf) return std::nullopt;
  return EmitterSample{to_vec3(normalize(x)), static_cast<float>(length(x)), to_vec3(normalize(n)), uv(point.p), *pdf};
}

float QuadricEmitter::pdf(const RoundedPoint& p, const RoundedPoint& hit) const {
  if (const auto h = cone_height(p)) return static_cast<float>(1 / (kTau * *h));
  if (!(object_area_ > 0)) return 0;
  const Vec3d object_n = object_normal(to_object(hit.at));
  const double pdf_area = 1 / (object_area_ * world_area_scale(object_n));
  return solid_angle_density(pdf_area, hit.at - p.at, world_normal(object_n)).value_or(0.0f);
}

}  // namespace tyndall
