/// From film positions to rays.
#pragma once

#include <array>
#include <optional>

#include "tyndall/scene.h"

namespace tyndall {

/// The scene's camera with its projection worked out. Semantics of pbrt's PerspectiveCamera,
/// OrthographicCamera and SphericalCamera.
class CameraRays {
 public:
  CameraRays(const Camera& camera, const Film& film);

  /// World ray through film position `p` (pixels of the full frame) and `lens` in [0,1)^2.
  Ray ray(Vec2 p, Vec2 lens) const;
  /// World position all rays of a pinhole share; the middle of the lens or of the screen otherwise.
  Vec3 center() const { return to_world_.point({0, 0, 0}); }
  /// Whether every ray starts at center() and goes through a plane: what film_position, solid_angle and film_rounding are for.
  bool is_pinhole() const { return kind_ == Camera::Kind::perspective && lens_radius_ == 0; }
  /// Whether it sees all around center().
  bool is_spherical() const {
    return kind_ == Camera::Kind::spherical_equal_area || kind_ == Camera::Kind::spherical_equirectangular;
  }
  /// How far a point of a plane at `p` with unit normal `n`, world space, moves for a step of one pixel to the right and
  /// down; as the camera would see it through its middle where it does not see it. Of a spherical camera, for a step of one
  /// mean pixel in two directions across.
  std::array<Vec3, 2> pixel_steps(Vec3 p, Vec3 n) const;
  /// Where on the film (pixels of the full frame) a pinhole sees world point `p`; nothing for what is behind it.
  std::optional<Vec2> film_position(Vec3 p) const;
  /// Of the film at `p`, as a pinhole sees it whose transform keeps angles: sr per pixel^2.
  float solid_angle(Vec2 p) const;
  /// Pixels below which film positions and the rays through them do not agree, for all the rounding.
  float film_rounding() const;
  /// Distance of world point `p` along the viewing axis; of a spherical camera, which has none, from its center.
  float depth(Vec3 p) const { return is_spherical() ? length(p - center()) : dot(p - center(), axis_); }
  const Transform& to_world() const { return to_world_; }
  /// World to camera space, and to the frame ([0,1]^2, y downward): for row vectors, as OpenEXR keeps matrices. No matrix does
  /// the latter for a spherical camera.
  std::array<float, 16> world_to_camera() const;
  std::array<float, 16> world_to_ndc() const;

 private:
  Transform to_world_;
  std::array<Vec3, 2> steps_across(Vec3 to_p) const;

  Camera::Kind kind_;
  float x0_, x1_, y0_, y1_;  ///< screen window, times tan(fov/2) in perspective
  float width_, height_;
  float lens_radius_, focal_distance_;
  Vec3 axis_;
};

}  // namespace tyndall
