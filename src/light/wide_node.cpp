#include "light/wide_node.h"

#include <cassert>

#include "math/half_float.h"

namespace tyndall {
namespace {

constexpr float kLeastNormal = std::numeric_limits<float>::min();

/// The nearest integer of x / step, for x within [-1, 1].
int steps(double x, double step) { return static_cast<int>(std::floor(std::clamp(x, -1.0, 1.0) / step + 0.5)); }

/// A cosine in steps, on the side of the wider angle. A whole step allows for rounding in what led here.
std::int16_t widened(double cosine) {
  return static_cast<std::int16_t>(std::floor(std::clamp(cosine - 2e-7, -1.0, 1.0) / WideNode::kStep));
}

/// Half the side of a box around `center`; what cannot be stored exactly becomes larger.
std::uint16_t half_side(float low, float high, float center) {
  const double half = std::max(double(high) - center, double(center) - low);
  return half > 0 ? upper_half_above(std::max(half, double(kLeastNormal))) : std::uint16_t(0);
}

/// Cosine of the cone about the stored axis that holds the cone about the true one.
std::int16_t cone_cosine(const DirectionCone& cone, Vec3d stored) {
  if (cone.full()) return -32767;
  const double aside = std::min(dot(normalize(Vec3d(cone.axis)), normalize(stored)), 1.0);
  const double o = cone.theta, sine = std::sqrt((1 - aside) * (1 + aside));
  if (o > 3) return -32767;
  const double cosine = o > 0 ? std::cos(o) * aside - std::sin(o) * sine : aside;
  return std::max<std::int16_t>(widened(cosine), -32766);
}

}  // namespace

void WideNode::set_children(std::span<const Cluster> clusters, std::span<const std::uint32_t> children) {
  assert(clusters.size() <= kWidth && clusters.size() == children.size());
  const std::uint32_t above = parent;
  *this = {};
  parent = above;
  double strongest = 0;
  for (const Cluster& c : clusters) strongest = std::max(strongest, c.intensity);
  scale = std::max(static_cast<float>(strongest), kLeastNormal);

  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const Cluster& c = clusters[i];
    Vec3d stored_axis;
    const Vec3d mean_at(c.mean);
    const std::array<double, 3> means{mean_at.x, mean_at.y, mean_at.z};
    for (int k = 0; k < 3; ++k) {
      center[k][i] = static_cast<float>(0.5 * (double(c.box.min[k]) + double(c.box.max[k])));
      half[k][i] = half_side(c.box.min[k], c.box.max[k], center[k][i]);
      axis[k][i] = static_cast<std::int16_t>(steps(c.normals.axis[k], kStep));
      const double offset = half[k][i] ? (means[k] - center[k][i]) / from_upper_half(half[k][i]) : 0;
      mean[k][i] = static_cast<std::int8_t>(steps(offset, kMeanStep));
    }
    stored_axis = Vec3d(axis[0][i], axis[1][i], axis[2][i]) * double(kStep);
    cos_o[i] = cone_cosine(c.normals, stored_axis);
    cos_e[i] = c.theta_e == kPi / 2 ? std::int16_t(-1) : std::max<std::int16_t>(widened(std::cos(double(c.theta_e))), -32767);
    intensity[i] = std::max<std::uint16_t>(upper_half_near(std::max(c.intensity / scale, 1e-24)), 1);
    deviation[i] = upper_half_near(std::sqrt(c.variance));
    intensity_cv2[i] = upper_half_near(c.intensity_cv2());
    flags[i] = (c.count == 1 ? kLeaf : 0) | (c.two_sided ? kTwoSided : 0);
    child[i] = children[i];
    count[i] = c.count;
  }
}

Cluster WideNode::cluster(int i) const {
  Cluster c;
  std::array<double, 3> means;
  for (int k = 0; k < 3; ++k) {
    const float h = from_upper_half(half[k][i]);
    c.box.min[k] = center[k][i] - h;
    c.box.max[k] = center[k][i] + h;
    means[static_cast<std::size_t>(k)] = center[k][i] + double(h) * mean[k][i] * kMeanStep;
  }
  const Vec3 direction{float(axis[0][i]), float(axis[1][i]), float(axis[2][i])};
  c.normals = cos_o[i] == -32767 ? DirectionCone::everything()
                                 : DirectionCone::around(normalize(direction), std::acos(cos_o[i] * kStep));
  c.theta_e = std::acos(cos_e[i] * kStep);
  c.two_sided = flags[i] & kTwoSided;
  c.count = count[i];
  c.intensity = double(from_upper_half(intensity[i])) * scale;
  c.mean = {means[0], means[1], means[2]};
  c.variance = double(from_upper_half(deviation[i])) * from_upper_half(deviation[i]);
  c.intensity_square = (1 + double(from_upper_half(intensity_cv2[i]))) * c.intensity * c.intensity / std::max(c.count, 1u);
  return c;
}

}  // namespace tyndall
