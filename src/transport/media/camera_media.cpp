#include "transport/media/camera_media.h"

#include <cmath>

namespace tyndall {
namespace {

constexpr int kDirections = 32;
constexpr double kNearlyAll = 0.85;

/// Directions spread evenly over the sphere by a golden-angle spiral.
Vec3 direction(int i) {
  const float z = 1 - (2 * static_cast<float>(i) + 1) / kDirections;
  const float phi = 2.399963f * static_cast<float>(i);
  const float r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

MediaState find_camera_media(std::optional<MediumId> declared, Vec3 center, const Geometry& geometry) {
  MediaState state(declared);
  const std::size_t groups = geometry.groups().size();
  if (groups == 0) return state;

  std::vector<int> votes(groups, 0);
  std::vector<int> depth_sum(groups, 0);
  for (int i = 0; i < kDirections; ++i) {
    std::vector<int> depth(groups, 0);  // how many times the ray leaves the group more often than it enters
    for (const Crossing& c : geometry.trace_all({center, direction(i)}, 0, kInfinity)) depth[c.group] -= c.sign;
    for (std::size_t g = 0; g < groups; ++g) {
      if (depth[g] <= 0) continue;
      ++votes[g];
      depth_sum[g] += depth[g];
    }
  }
  for (std::size_t g = 0; g < groups; ++g) {
    if (votes[g] < kNearlyAll * kDirections) continue;
    const int times = static_cast<int>(std::lround(static_cast<double>(depth_sum[g]) / votes[g]));
    for (int k = 0; k < times; ++k) state.cross(static_cast<std::uint32_t>(g), 1);
  }
  if (declared && state.brings(*declared, geometry.groups())) state.set_unbounded(std::nullopt);
  return state;
}

}  // namespace tyndall
