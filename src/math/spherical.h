/// Directions distributed uniformly over the solid angle of triangles, rectangles and spheres.
///
/// Everything is computed in double precision from positions relative to the observer, in forms that keep their
/// digits for tiny, huge and needle-like shapes.
#pragma once

#include <optional>

#include "math/vec3d.h"
#include "tyndall/math.h"

namespace tyndall {

/// A triangle projected on the unit sphere around an observer. Density of its samples: 1 / solid_angle().
class SphericalTriangle {
 public:
  /// Vertices relative to the observer.
  SphericalTriangle(Vec3d a, Vec3d b, Vec3d c);

  /// [0, 2 pi]; 0 or 2 pi when the observer lies in the triangle's plane.
  double solid_angle() const { return solid_angle_; }
  /// Unit direction; the solid angle must be neither 0 nor 2 pi.
  Vec3d sample(Vec2 u) const;

 private:
  Vec3d a_, b_, c_;
  Vec3d normal_;   ///< (b - a) x (c - a)
  double volume_;  ///< |a . normal_|: six times that of the tetrahedron over the triangle
  double solid_angle_;
};

/// A rectangle projected on the unit sphere around an observer [Urena et al. 2013].
/// Density of its samples: 1 / solid_angle().
class SphericalRectangle {
 public:
  /// `corner` relative to the observer; `edge_x` and `edge_y` must be perpendicular.
  SphericalRectangle(Vec3d corner, Vec3d edge_x, Vec3d edge_y);

  double solid_angle() const { return solid_angle_; }  ///< [0, 2 pi]
  struct Sample {
    Vec3d p;  ///< point on the rectangle relative to the observer
    Vec2 uv;  ///< its fractions of the two edges
  };
  Sample sample(Vec2 u) const;  ///< the solid angle must not be 0

 private:
  Vec3d x_, y_, z_;
  double length_x_, length_y_;
  double x0_, x1_, y0_, y1_, z0_;  ///< the rectangle in this frame, z0_ <= 0
  double b0_, b1_, k_;             ///< b0, b1, k of the paper
  double solid_angle_;
};

/// 1 - cos of the half angle under which a sphere of `radius` is seen from `distance` to its centre; nothing when the
/// observer is inside or on it. The full precision is kept for far spheres.
std::optional<double> sphere_cone_height(double distance, double radius);

}  // namespace tyndall
