/// Spheres, disks and cylinders, whole or cut, under any affine transform.
#pragma once

#include <variant>

#include "surface/shape_root.h"
#include "tyndall/scene.h"

namespace tyndall {

/// A quadric ready to be met by rays. Its surface parameters are (phi, theta) on a sphere, (phi, radius) on a disk and
/// (phi, z) on a cylinder, in radians and object space; phi in [0, 2 pi).
class PlacedQuadric {
 public:
  /// `shape` must be a sphere, disk or cylinder. Throws Error at its place when a size is not finite or not positive.
  explicit PlacedQuadric(const Shape& shape);

  ShapeRoots intersect(const ShapeRay& ray) const;
  ShapeSurface surface(double u, double v) const;
  ShapeTangents tangents(double u, double v) const;
  Bounds3 bounds() const;
  ShapeOutline outline(const ShapeView& view) const;  ///< of the whole quadric; empty from inside of a sphere
  Enclosure enclosure(Vec3d center) const;            ///< of a tessellation, by ng
  int orientation() const { return flip_ ? -1 : 1; }  ///< of ng against cross(dpdu, dpdv)

 private:
  enum class Kind { sphere, disk, cylinder };

  bool keeps(double phi, double z, double radius) const;
  ShapeOutline outline_of_sphere(const ShapeView& local) const;
  void push_root(ShapeRoots& roots, const ShapeRay& local, double t, int facing) const;

  Kind kind_;
  double radius_ = 1, inner_radius_ = 0;
  double z_min_ = -1, z_max_ = 1;  ///< of a disk: both its height
  double phi_max_ = 2 * 3.14159265358979323846;
  bool flip_ = false;  ///< reverse_orientation XOR mirrored, as pbrt: a mirrored sphere's normal points inside
  AffineMap map_;
  Transform to_space_;
};

}  // namespace tyndall
