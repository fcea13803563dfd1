/// Directly visible emission along a ray of the camera.
#pragma once

#include <optional>

#include "transport/sample/light_context.h"

namespace tyndall {

/// Optical depth before a light, roughly: beyond it less than a hundredth of its light gets through.
inline constexpr float kDeepestSeen = 5;

/// The surface that it hits first, if that is emissive.
struct DirectlyVisible {
  LightId light;
  EmitterHit hit;
  Rgb L;        ///< toward the camera, before media attenuate it
  Trace trace;  ///< of the ray, up to the surface
};
std::optional<DirectlyVisible> directly_visible(const BuiltWorld& world, const Ray& ray);

/// Unbiased estimate of the transmittance of the media before it.
Rgb attenuated(const LightContext& context, const Ray& ray, const DirectlyVisible& seen, Sampler& sampler);
/// The same, roughly, for choices: mean of the channels, and nothing where less than a hundredth gets through.
float attenuated_roughly(const BuiltWorld& world, const Ray& ray, const DirectlyVisible& seen);

}  // namespace tyndall
