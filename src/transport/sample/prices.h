/// What counted work costs.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "transport/sample/counters.h"
#include "tyndall/render.h"

namespace tyndall {

/// Costs by counts: choices made by clocks would not give the same picture twice. About ns of one core, and up to a factor that
/// depends on the scene (docs/measurements.md); of a light drawn for a vertex, down a tree of so many.
class Prices {
 public:
  explicit Prices(std::size_t lights) : levels_(std::log2(static_cast<double>(lights) + 1)) {}

  double of(const Counters& c) const {
    const WorkParts all = parts(c);
    double sum = 0;
    for (const auto& [name, part] : kWorkParts) sum += all.*part;
    return sum;
  }

  /// The same by what it is spent on.
  WorkParts parts(const Counters& c) const {
    constexpr double kRay = 960, kGuided = 410, kConnection = 90;
    constexpr double kChoice = 340, kCandidate = 32, kShadowRay = 200, kSegment = 1940, kPlace = 1340;
    constexpr double kPiece = 130, kLookup = 18, kNoiseLookup = 270;  // noise: what it costs more
    const auto cost = [](double price, std::uint64_t count) { return price * static_cast<double>(count); };
    WorkParts parts;
    parts.paths = cost(kRay, c.rays);
    parts.media =
        cost(kPiece, c.tracking.segments) + cost(kLookup, c.tracking.lookups) + cost(kNoiseLookup, c.tracking.noise_lookups);
    parts.vertex_lights = cost(kChoice, c.choices) + levels_ * cost(kCandidate, c.candidates);
    parts.segment_lights = cost(kSegment, c.segments) + cost(kPlace, c.places);
    parts.shadow_rays = cost(kShadowRay, c.shadow_rays);
    parts.sharing = cost(kConnection, c.connections);
    parts.guiding = cost(kGuided, c.guided);
    return parts;
  }

 private:
  double levels_;
};

}  // namespace tyndall
