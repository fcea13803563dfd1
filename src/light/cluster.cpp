#include "light/cluster.h"

namespace tyndall {

double Cluster::intensity_cv2() const {
  return intensity > 0 ? std::max(count * intensity_square / (intensity * intensity) - 1, 0.0) : 0;
}

Cluster cluster_of(const LightBounds& light) {
  const Vec3d low(light.box.min), high(light.box.max), extent = high - low;
  Cluster c;
  c.box = light.box;
  c.normals = light.normals;
  c.theta_e = light.theta_e;
  c.two_sided = light.two_sided;
  c.count = 1;
  c.intensity = light.intensity;
  c.intensity_square = c.intensity * c.intensity;
  c.mean = low * 0.5 + high * 0.5;
  c.variance = dot(extent, extent) / 12;
  return c;
}

namespace {

/// For rounding an axis to float and adding up angles.
constexpr double kWidening = 1e-6;

void add_moments(Cluster& a, const Cluster& b) {
  const double sum = a.intensity + b.intensity;
  const double share = sum > 0 ? b.intensity / sum : 0;
  const Vec3d apart = b.mean - a.mean;
  a.mean = a.mean + apart * share;
  a.variance = (1 - share) * a.variance + share * b.variance + share * (1 - share) * dot(apart, apart);
  a.intensity = sum;
  a.intensity_square += b.intensity_square;
}

/// A cone about the mean of the axes: of many cones it is tighter than unions in pairs.
DirectionCone cone_of_all(std::span<const Cluster> clusters, bool two_sided) {
  Vec3d sum;
  const Vec3d first(clusters.front().normals.axis);
  const auto turned = [&](const Cluster& c) {
    const Vec3d axis(c.normals.axis);
    return two_sided && dot(axis, first) < 0 ? -axis : axis;
  };
  for (const Cluster& c : clusters) {
    if (c.normals.full()) return DirectionCone::everything();
    sum = sum + turned(c);
  }
  if (!(length(sum) > 1e-3)) return DirectionCone::everything();
  const Vec3 axis = to_vec3(normalize(sum));
  double theta = 0;
  for (const Cluster& c : clusters) {
    const double half_chord = 0.5 * length(turned(c) - Vec3d(axis));
    theta = std::max(theta, 2 * std::asin(std::min(half_chord, 1.0)) + c.normals.theta);
  }
  if (theta == 0) return DirectionCone::around(axis);
  return theta + kWidening < kPi ? DirectionCone::around(axis, static_cast<float>(theta + kWidening))
                                 : DirectionCone::everything();
}

}  // namespace

Cluster cluster_union(std::span<const Cluster> clusters) {
  Cluster all;
  for (const Cluster& c : clusters) {
    all.box.expand(c.box);
    all.theta_e = std::max(all.theta_e, c.theta_e);
    all.two_sided = all.two_sided || c.two_sided;
    all.count += c.count;
    add_moments(all, c);
  }
  all.normals = cone_of_all(clusters, all.two_sided);
  return all;
}

}  // namespace tyndall
