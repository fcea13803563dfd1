#include "transport/media/media_state.h"

#include <algorithm>

namespace tyndall {

Bounds3 reach_of(MediumId medium, const std::vector<BoundaryGroup>& groups, std::optional<MediumId> unbounded) {
  if (unbounded == medium) return {Vec3{-kInfinity, -kInfinity, -kInfinity}, Vec3{kInfinity, kInfinity, kInfinity}};
  Bounds3 reach;
  for (const BoundaryGroup& group : groups) {
    if (group.inside == medium) reach.expand(group.bounds);
  }
  return reach;
}

Bounds3 overlap(const Bounds3& a, const Bounds3& b) { return {max(a.min, b.min), min(a.max, b.max)}; }

float distance_outside(const Bounds3& box, Vec3 p) { return length(max(max(box.min - p, p - box.max), Vec3{0, 0, 0})); }

float exit_distance(const Bounds3& box, const Ray& ray) {
  float t = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.d[axis] == 0) continue;
    t = std::min(t, ((ray.d[axis] > 0 ? box.max[axis] : box.min[axis]) - ray.o[axis]) / ray.d[axis]);
  }
  return std::max(t, 0.0f);
}

bool MediaState::cross(std::uint32_t group, int sign) {
  for (std::size_t i = 0; i < inside_.size(); ++i) {
    if (inside_[i].group != group) continue;
    inside_[i].count += sign;
    if (inside_[i].count == 0) inside_.erase(i);
    return true;
  }
  if (sign < 0) return false;
  inside_.push_back({group, sign});
  return true;
}

ActiveMedia MediaState::active(const std::vector<BoundaryGroup>& groups, const std::vector<ParticipatingMedium>& media) const {
  ActiveMedia result;
  if (unbounded_) result.push_back(&media[*unbounded_]);
  for (const Membership& m : inside_) {
    if (const auto inside = groups[m.group].inside) result.push_back(&media[*inside]);
  }
  // Removals come last, so that the order in which groups were entered does not matter.
  for (const Membership& m : inside_) {
    const auto outside = groups[m.group].outside;
    if (!outside) continue;
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (result[i] != &media[*outside]) continue;
      result.erase(i);
      break;
    }
  }
  return result;
}

Bounds3 MediaState::bounds(const std::vector<BoundaryGroup>& groups) const {
  if (unbounded_) return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  Bounds3 box;
  for (const Membership& m : inside_) {
    if (groups[m.group].inside) box.expand(groups[m.group].bounds);
  }
  return box;
}

float MediaState::first_exit(const std::vector<BoundaryGroup>& groups, const Ray& ray) const {
  float t = kInfinity;
  for (const Membership& m : inside_) t = std::min(t, exit_distance(groups[m.group].bounds, ray));
  return t;
}

bool MediaState::brings(MediumId medium, const std::vector<BoundaryGroup>& groups) const {
  for (const Membership& m : inside_) {
    if (groups[m.group].inside == medium) return true;
  }
  return false;
}

}  // namespace tyndall
