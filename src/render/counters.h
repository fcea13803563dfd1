/// What one thread counts while it renders.
#pragma once

#include <cstdint>
#include <vector>

#include "tyndall/render.h"
#include "volume/tracking.h"

namespace tyndall {

struct Counters {
  std::uint64_t paths = 0, rays = 0, shadow_rays = 0, non_finite = 0, parity_errors = 0;
  TrackingStats tracking;
  std::vector<BadSample> bad_samples;

  Counters& operator+=(const Counters& other) {
    paths += other.paths;
    rays += other.rays;
    shadow_rays += other.shadow_rays;
    non_finite += other.non_finite;
    parity_errors += other.parity_errors;
    tracking += other.tracking;
    bad_samples.insert(bad_samples.end(), other.bad_samples.begin(), other.bad_samples.end());
    return *this;
  }
};

}  // namespace tyndall
