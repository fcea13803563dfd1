/// Single scattering on the camera's ray, whose film position and distance are drawn together for a light.
///
/// Film positions drawn by a pixel's filter seldom come close to the image of a point or spot light in smoke, and gather
/// 1/distance of its light when they do. So each sample also takes a ray that passes a light of its pixel (point_images.h),
/// weighted by MIS, light by light, against what the path's own ray from the camera gathers.
#pragma once

#include "transport/pixel/film_search.h"
#include "transport/pixel/point_images.h"
#include "transport/techniques/mis.h"

namespace tyndall {

/// The lights to be drawn for the pixels: point and spot lights within boxes of media. None where settings or the camera rule
/// it out: only rays from a pinhole are drawn.
FilmPoints film_points(const FilmSearch& search);

/// Unbiased estimate, for the pixel at `center`, of the share of single scattering that CameraJointWeight::path_mis_weight does
/// not leave to the filter's samples. `points`, the pixel's, must not be empty.
Rgb camera_joint_estimate(const LightContext& context, const PixelPoints& points, Vec2 center, Sampler sampler);

/// The camera's ray that a pixel's filter has drawn.
class CameraJointWeight final : public JointWeight {
 public:
  /// Through film position `x`, drawn with density `pdf` in 1/pixels^2. `points` must outlive it.
  CameraJointWeight(const PixelPoints& points, Vec2 x, float pdf) : points_(points), x_(x), pdf_(pdf) {}
  float path_mis_weight(const LightContext& context, LightId light) const override;

 private:
  const PixelPoints& points_;
  Vec2 x_;
  float pdf_;
};

}  // namespace tyndall
