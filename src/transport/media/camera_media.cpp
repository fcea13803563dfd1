#include "transport/media/camera_media.h"

#include <cmath>

namespace tyndall {
namespace {

constexpr double kNearlyAll = 0.85;

}  // namespace

/// By a golden-angle spiral.
std::array<Vec3, 32> directions_all_around() {
  std::array<Vec3, 32> directions;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const float z = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(directions.size());
    const float phi = 2.399963f * static_cast<float>(i);
    const float r = std::sqrt(1 - z * z);
    directions[i] = {r * std::cos(phi), r * std::sin(phi), z};
  }
  return directions;
}

MediaState find_camera_media(std::optional<MediumId> declared, Vec3 center, const Geometry& geometry) {
  MediaState state(declared);
  const std::size_t groups = geometry.groups().size();
  if (groups == 0) return state;

  std::vector<int> votes(groups, 0);
  std::vector<int> depth_sum(groups, 0);
  const auto directions = directions_all_around();
  for (const Vec3 direction : directions) {
    std::vector<int> depth(groups, 0);  // how many times the ray leaves the group more often than it enters
    for (const Crossing& c : geometry.trace_all({center, direction}, 0, kInfinity)) depth[c.group] -= c.sign;
    for (std::size_t g = 0; g < groups; ++g) {
      if (depth[g] <= 0) continue;
      ++votes[g];
      depth_sum[g] += depth[g];
    }
  }
  for (std::size_t g = 0; g < groups; ++g) {
    if (votes[g] < kNearlyAll * directions.size()) continue;
    const int times = static_cast<int>(std::lround(static_cast<double>(depth_sum[g]) / votes[g]));
    for (int k = 0; k < times; ++k) state.cross(static_cast<std::uint32_t>(g), 1);
  }
  if (declared && state.brings(*declared, geometry.groups())) state.set_unbounded(std::nullopt);
  return state;
}

}  // namespace tyndall
