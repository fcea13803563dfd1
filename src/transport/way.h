/// Light by way of one more event, at a place that was drawn for a lamp.
#pragma once

#include "transport/light_context.h"

namespace tyndall {

/// A ray from where path or camera is, to where it scatters next.
struct Way {
  const MediaState& start;  ///< media at its origin; must outlive it
  Ray ray;
  float t;  ///< > 0, length
};

/// Unbiased estimate of what media at the way's end send back along it of a point or spot light: radiance per length, times the
/// square of the distance between that end and the lamp, near which neither factor is of a useful size.
Rgb lamplight(const LightContext& context, const Way& way, LightId lamp, Sampler& sampler);

}  // namespace tyndall
