/// The question put to light selection by a segment of a ray through media: which light matters to the light that is scattered
/// along it.
#pragma once

#include <array>

#include "tyndall/math.h"
#include "tyndall/settings.h"

namespace tyndall {

/// What media do along a segment and around it, in a few bins: nothing finer than a choice of lights can use. Only
/// weights the choice; no estimate is made from it.
struct SegmentProfile {
  /// With fewer, choices are worse; more cost more than they save (docs/measurements.md).
  static constexpr int kBins = 4;
  std::array<float, kBins + 1> edge{};    ///< distances along the ray, increasing; the last may be infinite
  std::array<float, kBins> scattering{};  ///< mean of sigma_s x transmittance from the origin over the bin, >= 0
  std::array<float, kBins> sigma{};       ///< mean extinction from the bin toward lights, 1/length
  std::array<float, kBins> escape{};      ///< optical depth at most toward lights (the medium ends); may be infinite
  float g = 0;                            ///< mean cosine of the phase function, Henyey-Greenstein
};

/// The part of a ray between `t0` and `t1`.
struct SegmentQuery {
  Vec3 o, d;                                          ///< d is unit
  float t0, t1;                                       ///< 0 <= t0 < t1; t1 may be infinite
  MediaStrategy importance = MediaStrategy::product;  ///< closest, integral or product
  /// Distance within which most of the light that is scattered along the ray is: stands for t1 - t0 where that is
  /// longer, and for the length in the importance of lights at infinity. Length, > 0, finite.
  float reach = 1;
  SegmentProfile profile{};  ///< read by `product` only
};

}  // namespace tyndall
