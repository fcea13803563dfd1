/// From film positions to rays.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "math/polygon.h"
#include "surface/shape_root.h"
#include "tyndall/scene.h"

namespace tyndall {

class LensSystem;

/// The scene's camera with its projection worked out. Semantics of pbrt's PerspectiveCamera,
/// OrthographicCamera, SphericalCamera and RealisticCamera.
class CameraRays {
 public:
  CameraRays(const Camera& camera, const Film& film);

  /// World ray through film position `p` (pixels of the full frame) and `lens` in [0,1)^2; not of a realistic camera.
  Ray ray(Vec2 p, Vec2 lens) const;
  struct Sample {
    Ray ray;
    float weight;  ///< of the radiance along it
  };
  /// The same for any camera; nothing where no light comes from there through a realistic camera's lenses.
  std::optional<Sample> sample(Vec2 p, Vec2 lens) const;
  /// World position all rays of a pinhole share; the middle of the lens or of the screen otherwise.
  Vec3 center() const { return to_world_.point({0, 0, 0}); }
  /// Whether every ray starts at center() and goes through a plane.
  bool is_pinhole() const { return kind_ == Camera::Kind::perspective && lens_radius_ == 0; }
  /// Whether it sees all around center().
  bool is_spherical() const {
    return kind_ == Camera::Kind::spherical_equal_area || kind_ == Camera::Kind::spherical_equirectangular;
  }
  bool is_realistic() const { return kind_ == Camera::Kind::realistic; }
  /// Whether the frame is a plane through which all rays go to a point, or in parallel.
  bool has_projection() const { return !is_spherical() && !is_realistic(); }
  /// How far a point of a plane at `p` with unit normal `n`, world space, moves for a step of one pixel to the right and
  /// down; as the camera would see it through its middle where it does not see it. Of a spherical camera, for a step of one
  /// mean pixel in two directions across.
  std::array<Vec3, 2> pixel_steps(Vec3 p, Vec3 n) const;
  /// Whether every point before it is seen at one place of the film: a pinhole, or without perspective, and no lens.
  bool is_sharp() const { return has_projection() && lens_radius_ == 0; }
  /// Where a camera with a projection sees a point: through a place q on its lens, the unit disk, at `at` + q * `by`, axis by
  /// axis.
  struct Image {
    Point2 at;  ///< pixels of the full frame
    Point2 by;  ///< pixels, of opposite sign behind what is in focus and before it; 0 where the camera is_sharp()
    /// The place on the lens through which it is seen at `film`.
    Point2 on_lens(Point2 film) const { return {(film.x - at.x) / by.x, (film.y - at.y) / by.y}; }
  };
  /// Nothing for what is not before it.
  std::optional<Image> blurred_image_of(Vec3d p) const;
  /// Through the middle of the lens.
  std::optional<Point2> image_of(Vec3d p) const;
  /// The same in single precision.
  std::optional<Vec2> film_position(Vec3 p) const;
  /// Its ray through a film position and a place on the lens, exact but for the rounding of the ray.
  Ray ray_through(Point2 film, Point2 lens = {0, 0}) const;
  /// From where it sees what it sees through the middle of the lens; from where it sees `p`.
  ShapeView view() const;
  Vec3 eye_of(Vec3 p) const;
  /// World position where all rays through a film position meet that come from a lens.
  Vec3d focus_of(Point2 film) const;
  /// Pixels below which film positions and the rays through them do not agree, for all the rounding; of a camera with a
  /// projection.
  float film_rounding() const;
  /// Distance of world point `p` along the viewing axis; of a spherical camera, which has none, from its center.
  float depth(Vec3 p) const { return is_spherical() ? length(p - center()) : dot(p - center(), axis_); }
  const Transform& to_world() const { return to_world_; }
  /// World to camera space, and to the frame ([0,1]^2, y downward): for row vectors, as OpenEXR keeps matrices. No matrix does
  /// the latter where there is no projection.
  std::array<float, 16> world_to_camera() const;
  std::array<float, 16> world_to_ndc() const;

 private:
  Transform to_world_;
  Transform::Matrix to_camera_;
  void look_through(const Lenses& lenses);
  std::array<float, 4> seen_by_film() const;
  std::array<Vec3, 2> steps_across(Vec3 to_p) const;
  Point2 on_screen(Point2 film) const;
  Vec3d focus_on(Point2 screen) const;
  Vec3d in_world(Vec3d v, double w) const;

  Camera::Kind kind_;
  float x0_, x1_, y0_, y1_;  ///< screen window, times tan(fov/2) in perspective
  float width_, height_;
  float lens_radius_, focal_distance_;
  Vec3 axis_;
  Vec2 film_size_;                            ///< of a realistic camera, camera space
  std::shared_ptr<const LensSystem> lenses_;  ///< null where only the frame counts
};

}  // namespace tyndall
