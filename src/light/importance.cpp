#include "light/importance.h"

#include "light/emission_angle.h"

namespace tyndall {
namespace {

/// The next float toward the wider angle; a cosine of exactly 1 belongs to an angle of exactly 0.
float widened_cosine(float angle) {
  if (angle <= 0) return 1;
  return std::max(std::nextafter(static_cast<float>(std::cos(static_cast<double>(angle))), -2.0f), -1.0f);
}

/// No point of the box is above the tangent plane.
bool wholly_below(const Bounds3& box, Vec3d n, Vec3d to_center, Vec3d half) {
  const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
  const double margin = kCosineSlack * (length(to_center) + length(half));
  return !box.empty() && dot(n, to_center) + reach <= -margin;
}

/// A cluster's box as a point sees it.
struct BoxView {
  Vec3d half, to_center;
  double radius, distance;  ///< of the sphere around it; of its centre

  BoxView(const Bounds3& box, Vec3 point) {
    const Vec3d low(box.min), high(box.max), p(point);
    half = (high - low) * 0.5;
    to_center = (low - p) * 0.5 + (high - p) * 0.5;
    radius = length(half);
    distance = length(to_center);
  }
};

/// The largest product of the cosines of emission and incidence that any light in the box may have; 0: none can contribute.
double largest_factor(const ClusterBounds& cluster, bool two_sided, const BoxView& view, const PointQuery& query) {
  const Vec3d n(query.n);
  const bool surface = dot(n, n) > 0;
  if (surface && !query.transmissive && wholly_below(cluster.box, n, view.to_center, view.half)) return 0;
  // The sphere around the box is seen under theta_u; from inside it nothing is known of directions.
  if (!(view.distance > view.radius)) return 1;
  const Angle theta_u = Angle::from_sine(view.radius / view.distance);
  double factor = 1;

  // How far beyond the normals' cone the point lies.
  if (cluster.cos_o > -1) {
    const double c = -dot(Vec3d(cluster.axis), view.to_center) / view.distance;
    factor = emission_factor(cluster, Angle::from_cosine(two_sided ? std::abs(c) : c), theta_u);
    if (factor == 0) return 0;
  }

  // The largest cosine at which its light can arrive.
  if (surface) {
    const double c = dot(n, view.to_center) / view.distance;
    const Angle theta_i = Angle::from_cosine(query.transmissive ? std::abs(c) : c);
    factor *= std::max(reduced(theta_i, theta_u).cos, kLeastFactor);
  }
  return factor;
}

}  // namespace

ClusterBounds ClusterBounds::from(const LightBounds& b) {
  return {b.box, b.normals.axis, b.normals.full() ? -1 : widened_cosine(b.normals.theta), widened_cosine(b.theta_e),
          b.intensity};
}

double importance(const ClusterBounds& cluster, bool two_sided, const PointQuery& query) {
  const BoxView view(cluster.box, query.p);
  const double factor = largest_factor(cluster, two_sided, view, query);
  // A light without extent at the very point gives nothing that could be used.
  const double distance = std::max(view.distance, 0.5 * view.radius);
  if (!(distance > 0)) return 0;
  const double result = factor * cluster.intensity / (distance * distance);
  return result > 0 ? result : 0;
}

double greatest_importance(const ClusterBounds& cluster, bool two_sided, const PointQuery& query) {
  const BoxView view(cluster.box, query.p);
  const double factor = largest_factor(cluster, two_sided, view, query);
  const auto beyond = [](double to_center, double half) { return std::max(std::abs(to_center) - half, 0.0); };
  const Vec3d c = view.to_center, h = view.half;
  const Vec3d to_box{beyond(c.x, h.x), beyond(c.y, h.y), beyond(c.z, h.z)};
  return factor > 0 ? factor * cluster.intensity / dot(to_box, to_box) : 0;
}

double least_importance(const ClusterBounds& cluster, bool two_sided, const PointQuery& query) {
  const auto [half, to_center, radius, distance] = BoxView(cluster.box, query.p);
  const Vec3d n(query.n);
  if (!(dot(n, n) > 0) || distance <= radius) return 0;

  // theta + theta_o + theta_u is as far off a normal as the light may have to leave; so with the receiver's normal.
  const Angle theta_u = Angle::from_sine(radius / distance);
  const double out = -dot(Vec3d(cluster.axis), to_center) / distance, in = dot(n, to_center) / distance;
  const Angle theta =
      increased(increased(Angle::from_cosine(two_sided ? std::abs(out) : out), Angle::from_cosine(cluster.cos_o)), theta_u);
  const Angle theta_i = increased(Angle::from_cosine(query.transmissive ? std::abs(in) : in), theta_u);
  if (theta.cos <= std::max<double>(cluster.cos_e, 0) || theta_i.cos <= 0) return 0;
  return theta.cos * theta_i.cos * cluster.intensity / ((distance + radius) * (distance + radius));
}

}  // namespace tyndall
