/// Photographic lenses, ray by ray: what a realistic camera looks through [Kolb et al. 1995].
///
/// Camera space: the film lies in z = 0 and looks along +z, the lenses stand before it about the z axis.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "math/vec3d.h"
#include "tyndall/scene.h"

namespace tyndall {

struct LensRay {
  Vec3d o, d;  ///< d is a unit vector
};

class LensSystem {
 public:
  /// Focused. Error at the lenses' place where they cannot be, or where no light comes through to the film's middle.
  explicit LensSystem(const Lenses& lenses);

  struct Sample {
    LensRay ray;
    double weight;  ///< radiance that comes in along it, times this, is irradiance for a film of 1 sr
  };
  /// From `film` through a point of the exit pupil, `pupil` in [0,1)^2; nothing where a lens or the stop ends it.
  std::optional<Sample> sample(Vec2 film, Vec2 pupil) const;

  /// From the film into the scene, with what the stop lets pass.
  std::optional<Sample> to_scene(LensRay ray) const;
  /// In reverse, up to the last surface before the film; the stop is a circle.
  std::optional<LensRay> to_film(LensRay ray) const;

  double rear_z() const { return surfaces_.back().z; }
  double front_z() const { return surfaces_.front().z; }
  /// From the rear principal plane to the film: a film point's distance from the axis over this is the slope of what it sees.
  double image_distance() const { return image_distance_; }

 private:
  /// Front first, as in a lens file.
  struct Surface {
    double z, radius;
    double eta_front, eta_behind;
    double aperture_radius;
    bool is_stop() const { return radius == 0; }
  };
  /// On the plane of the rear surface, for a film point on +x.
  struct Pupil {
    double x0 = 0, x1 = 0, y1 = 0;  ///< from -y1 to y1
    bool is_empty() const { return !(x1 > x0 && y1 > 0); }
    double area() const { return is_empty() ? 0 : (x1 - x0) * 2 * y1; }
  };
  static constexpr int kPupils = 64;  ///< by distance from the film's middle

  void place_surfaces(const std::vector<LensElement>& elements);
  void focus(const Lenses& lenses);
  Pupil pupil_within(Pupil region, int cells, double film0, double film1) const;
  Pupil exit_pupil(double film0, double film1, const Pupil& neighbour) const;
  static std::optional<LensRay> through(const Surface& surface, LensRay ray);

  std::vector<Surface> surfaces_;
  Lenses::Stop stop_;
  double image_distance_ = 0, film_radius_;
  std::array<Pupil, kPupils> pupils_;
};

/// What a stop of unit radius lets pass at (x, y): pbrt's shapes, as bright on average as the circle.
double stop_transmission(Lenses::Stop stop, double x, double y);

}  // namespace tyndall
