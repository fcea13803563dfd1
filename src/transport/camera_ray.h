/// From film positions to rays.
#pragma once

#include <array>
#include <optional>

#include "tyndall/scene.h"

namespace tyndall {

/// The scene's camera with its projection worked out. Semantics of pbrt's PerspectiveCamera and OrthographicCamera.
class CameraRays {
 public:
  CameraRays(const Camera& camera, const Film& film);

  /// World ray through film position `p` (pixels of the full frame) and `lens` in [0,1)^2.
  Ray ray(Vec2 p, Vec2 lens) const;
  /// World position all rays of a pinhole share; the middle of the lens or of the screen otherwise.
  Vec3 center() const { return to_world_.point({0, 0, 0}); }
  /// Whether every ray starts at center().
  bool is_pinhole() const { return !orthographic_ && lens_radius_ == 0; }
  /// How far a point of a plane at `p` with unit normal `n`, world space, moves for a step of one pixel to the right and
  /// down; as the camera would see it through its middle where it does not see it.
  std::array<Vec3, 2> pixel_steps(Vec3 p, Vec3 n) const;
  /// Where on the film (pixels of the full frame) a pinhole sees world point `p`; nothing for what is behind it.
  std::optional<Vec2> film_position(Vec3 p) const;
  /// Of the film at `p`, as a pinhole sees it whose transform keeps angles: sr per pixel^2.
  float solid_angle(Vec2 p) const;
  /// Pixels below which film positions and the rays through them do not agree, for all the rounding.
  float film_rounding() const;
  /// Distance of world point `p` along the viewing axis.
  float depth(Vec3 p) const { return dot(p - center(), axis_); }
  const Transform& to_world() const { return to_world_; }
  /// World to camera space, and to the frame ([0,1]^2, y downward): for row vectors, as OpenEXR keeps matrices.
  std::array<float, 16> world_to_ndc() const;
  std::array<float, 16> world_to_camera() const;

 private:
  Transform to_world_;
  bool orthographic_;
  std::array<Vec3, 2> steps_across(Vec3 to_p) const;

  float x0_, x1_, y0_, y1_;  ///< screen window, times tan(fov/2) in perspective
  float width_, height_;
  float lens_radius_, focal_distance_;
  Vec3 axis_;
};

}  // namespace tyndall
