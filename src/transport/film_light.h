/// Light of lamps by one event on the camera's ray, whose place on the film and distance are drawn together for a lamp.
///
/// Film positions that a pixel's filter draws seldom come close to the image of a lamp that stands in smoke, and find
/// 1/distance of its light when they do. So each sample also takes a ray that passes a lamp of its pixel (film_lamps.h), lamp
/// by lamp weighed by MIS against what the path's own ray from the camera gathers.
#pragma once

#include "transport/film_lamps.h"
#include "transport/film_search.h"
#include "transport/joint_ray.h"

namespace tyndall {

/// The lamps to be drawn for the pixels: points and spots within boxes of media. None where settings or the camera do
/// not have it: only rays from a pinhole are drawn.
FilmLamps film_lamps(const FilmSearch& search);

/// Unbiased estimate, for the pixel at `center`, of the share of lamps' light that FilmRay::own_share does not leave to the
/// filter's samples. `lamps`, the pixel's, must not be empty.
Rgb film_light(const LightContext& context, const PixelLamps& lamps, Vec2 center, Sampler sampler);

/// The camera's ray that a pixel's filter has drawn.
class FilmRay final : public JointRay {
 public:
  /// Through film position `x`, drawn with density `pdf` in 1/pixels^2. `lamps` must outlive it.
  FilmRay(const PixelLamps& lamps, Vec2 x, float pdf) : lamps_(lamps), x_(x), pdf_(pdf) {}
  float own_share(const LightContext& context, LightId light) const override;

 private:
  const PixelLamps& lamps_;
  Vec2 x_;
  float pdf_;
};

}  // namespace tyndall
