/// What a ray of a pinhole camera sees shining.
#pragma once

#include <optional>

#include "transport/light_context.h"

namespace tyndall {

/// The surface that it meets first, if that shines.
struct SeenLight {
  LightId light;
  EmitterHit hit;
  Rgb L;        ///< toward the camera, before media dim it
  Trace trace;  ///< of the ray, up to the surface
};
std::optional<SeenLight> seen_light(const BuiltWorld& world, const Ray& ray);

/// Unbiased estimate of the share of it that media let through.
Rgb dimmed(const LightContext& context, const Ray& ray, const SeenLight& seen, Sampler& sampler);
/// The same, roughly, for choices: mean of the channels, and nothing where less than a hundredth comes through.
float dimmed_roughly(const BuiltWorld& world, const Ray& ray, const SeenLight& seen);

}  // namespace tyndall
