/// What work costs, by counts. Choices made by clocks would not give the same picture twice.
#pragma once

#include <cmath>
#include <cstddef>

#include "transport/sample/light_context.h"

namespace tyndall {

/// ns of one core, about (docs/measurements.md); of a light drawn for a vertex or along a segment, down a tree of so many.
class Prices {
 public:
  explicit Prices(std::size_t lights) : levels_(std::log2(static_cast<double>(lights) + 1)) {}

  double of(const Counters& c) const {
    constexpr double kRay = 1850, kShadowRay = 500, kLookup = 25, kCandidate = 30, kPair = 160;
    return kRay * static_cast<double>(c.rays) + kShadowRay * static_cast<double>(c.shadow_rays) +
           kLookup * static_cast<double>(c.tracking.lookups) +
           levels_ * (kCandidate * static_cast<double>(c.candidates) + kPair * static_cast<double>(c.pairs));
  }

 private:
  double levels_;
};

/// Of all that the context's thread has counted.
inline double cost_so_far(const LightContext& context) { return Prices(context.world.lights.size()).of(context.counters); }

}  // namespace tyndall
