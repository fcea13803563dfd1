#include "light/split_measure.h"

#include <cmath>

namespace tyndall {
namespace {

/// The sphere around a box.
struct Sphere {
  Vec3d center;
  double radius;

  explicit Sphere(const Bounds3& box)
      : center((Vec3d(box.min) + Vec3d(box.max)) * 0.5), radius(0.5 * length(Vec3d(box.max) - Vec3d(box.min))) {}
};

SplitMeasure measure_at(const Cluster& cluster, double distance, double radius) {
  SplitMeasure m;
  m.nearest = std::max(distance - radius, 0.0);
  m.farthest = distance + radius;
  if (cluster.count <= 1 && radius == 0) return m;
  if (!(m.nearest > 0)) {
    m.cv2 = kInfinity;
    return m;
  }
  // Squared distances uniform on [a, b]: E[g^2] / E[g]^2 - 1 = (b - a)^2 / (3 a b) for g = 1 / d^2.
  const double distance_cv2 = (m.farthest - m.nearest) * (m.farthest - m.nearest) / (3 * m.nearest * m.farthest);
  m.cv2 = (1 + cluster.intensity_cv2()) * (1 + distance_cv2) - 1;
  return m;
}

/// Of exp(-x) for x uniform on an interval of this length: x / 2 coth(x / 2) - 1.
double transmittance_cv2(double depth) { return depth > 1e-3 ? 0.5 * depth / std::tanh(0.5 * depth) - 1 : depth * depth / 12; }

/// Optical depth from the segment's place `t` toward a cluster, over a length.
double depth_of(const WideSegment& segment, double t, double stretch) {
  for (int i = 0; i < segment.bins; ++i) {
    const WideSegment::Bin& bin = segment.bin[static_cast<std::size_t>(i)];
    if (t <= bin.end || i + 1 == segment.bins) return std::min(double(bin.sigma) * stretch, double(bin.escape));
  }
  return 0;
}

}  // namespace

SplitMeasure split_measure(const Cluster& cluster, const WideSegment& segment) {
  const Sphere sphere(cluster.box);
  const Vec3d p(segment.p), d(segment.d);
  const double t = std::clamp(dot(sphere.center - p, d), double(segment.from), double(segment.till));
  SplitMeasure m = measure_at(cluster, length(p + d * t - sphere.center), sphere.radius);
  if (segment.importance != MediaStrategy::product || !(m.nearest > 0)) return m;
  const double far_end = segment.g > 0 ? segment.from : segment.till;
  const double phase_cv2 = lobe_cv2(phase_lobe(segment.g, segment.d), p + d * far_end, cluster);
  m.cv2 = (1 + m.cv2) * (1 + transmittance_cv2(depth_of(segment, t, m.farthest - m.nearest))) * (1 + phase_cv2) - 1;
  return m;
}

double lobe_cv2(const ConeLobe& lobe, Vec3d p, const Cluster& cluster) {
  const Sphere sphere(cluster.box);
  const Vec3d to_center = sphere.center - p;
  const double distance = length(to_center);
  if (!(lobe.width > 0) || distance <= sphere.radius) return 0;
  const double seen = std::asin(sphere.radius / distance);
  const double off = std::acos(std::clamp(dot(to_center, Vec3d(lobe.axis)) / distance, -1.0, 1.0));
  constexpr double kReach = 2;  // widths: GGX has fallen to a hundredth
  if (off - seen > kReach * lobe.width) return 0;
  const double widths = seen / lobe.width;
  return widths * widths;
}

// (1 + g^2 - 2 g cos)^(3/2) = 2 (1 - g)^3 at half of the peak.
ConeLobe phase_lobe(float g, Vec3 d) {
  const float a = std::abs(g);
  const float sine2 = (std::cbrt(4.0f) - 1) * (1 - a) * (1 - a) / std::max(4 * a, 1e-6f);  // of half the angle
  if (sine2 >= 0.5f) return {};
  return {g > 0 ? d : -d, 2 * std::asin(std::sqrt(sine2))};
}

}  // namespace tyndall
