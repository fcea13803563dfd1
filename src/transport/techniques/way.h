/// Light by one more collision, at a place that was drawn for a point or spot light.
#pragma once

#include "transport/sample/light_context.h"

namespace tyndall {

/// A ray from a vertex or the camera to where it scatters next.
struct Way {
  const MediaState& start;  ///< media at its origin; must outlive it
  Ray ray;
  float t;  ///< > 0, length
};

/// Unbiased estimate of what media at the ray's end scatter back along it of a point or spot light: radiance per length, times
/// the square of the distance between that end and the light, since neither factor stays bounded near it.
Rgb in_scattered(const LightContext& context, const Way& way, LightId point, Sampler& sampler);

}  // namespace tyndall
