/// Directly visible emission of surfaces, where they end within a pixel: film positions are drawn on their images.
#pragma once

#include "transport/pixel/film_emitters.h"
#include "transport/sample/light_context.h"

namespace tyndall {

/// Unbiased estimate, for the pixel at `center`, of that light from `emitters`, which must not be empty. The camera's own ray
/// counts nothing of them (DrawnEmission).
Rgb visible_emitters(const LightContext& context, const PixelEmitters& emitters, Vec2 center, Sampler sampler);

}  // namespace tyndall
