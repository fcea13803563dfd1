#include "transport/path/camera_segment.h"

#include <algorithm>
#include <cmath>

#include "transport/media/span_distance.h"
#include "transport/media/transmittance_walk.h"

namespace tyndall {
const std::optional<SpanProfile>& CameraSegment::profile() {
  if (!looked_) {
    looked_ = true;
    profile_ = SpanProfile::of(span_, SpanProfile::Bins::few);
    g_ = mean_cosine(span_);
  }
  return profile_;
}

float CameraSegment::chance_of_passing() { return profile() ? std::exp(-profile_->optical_depth()) : 1.0f; }

DistanceSampler CameraSegment::distances_to(std::optional<Vec3> p) {
  return DistanceSampler(*profile(), span_.ray, LightPlace{.center = p}, DistanceSampler::Weights{g_});
}

Rgb CameraSegment::transmittance(TransmittanceStrategy strategy, TrackingStats& stats) {
  const double chance = std::min(1.0, kSeenMore * double{chance_of_passing()});
  if (!(rng_.uniform_wide() < chance)) return {};
  return TransmittanceWalk({strategy, kSegmentSpacing}, span_, rng_, stats).to(span_.t_end) * static_cast<float>(1 / chance);
}

}  // namespace tyndall
