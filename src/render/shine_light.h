/// What small shining surfaces send straight to the camera, by aiming at them.
///
/// Each sample of a pixel that sees such surfaces (film_shine.h) also takes the ray to a point of one of them, surface by surface
/// weighed by MIS against the filter's own sample, which may meet it.
#pragma once

#include "math/parallel.h"
#include "render/film_shine.h"
#include "render/light_context.h"

namespace tyndall {

/// Those to aim at for pixels of `pixels`: shining primitives that stand for themselves, not shared by instances. None where
/// settings or the camera do not have it: only rays of a pinhole that is not distorted are aimed.
FilmShine film_shine(const World::Parts& world, const RenderSettings& settings, const PixelBounds& pixels, ThreadPool& pool);

/// Unbiased estimate, for the pixel at `center`, of the share of that light which ShineRay::own_share does not leave to the
/// filter's samples. `shine`, the pixel's, must not be empty.
Rgb shine_light(const LightContext& context, const PixelShine& shine, Vec2 center, Sampler sampler);

/// The camera's ray that a pixel's filter drew. LightContext::shine points to it, all along its path.
class ShineRay {
 public:
  /// `pdf`: of its film position, 1/pixels^2. `shine` must outlive it.
  ShineRay(const PixelShine& shine, float pdf) : shine_(shine), pdf_(pdf) {}
  /// MIS weight of what it meets of `light`, unscattered.
  float own_share(const World::Parts& world, LightId light, const EmitterHit& hit) const;

 private:
  const PixelShine& shine_;
  float pdf_;
};

}  // namespace tyndall
