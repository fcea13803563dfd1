/// Emissive spheres, disks and cylinders, whole or cut, under any affine transform.
#pragma once

#include "light/emitter_sample.h"
#include "light/light_place.h"
#include "tyndall/scene.h"

namespace tyndall {

class QuadricEmitter {
 public:
  /// `shape` must be a sphere, disk or cylinder. `opaque`: only the side facing the observer of a whole sphere is ever
  /// seen from outside, and it alone is sampled.
  QuadricEmitter(const Shape& shape, const Transform& to_world, bool opaque);

  double area() const { return area_; }
  /// Largest area of a projection, roughly: what its intensity is computed from.
  double projected_area() const { return projected_area_; }
  EmitterExtent extent() const;
  LightPlace place() const;  ///< flat for disks

  /// Whole spheres under similarities: uniform in the cone they are seen under, from outside. All else: uniform over
  /// the surface in object space, by its true density in the world.
  std::optional<EmitterSample> sample(const RoundedPoint& p, Vec2 u) const;
  float pdf(const RoundedPoint& p, const RoundedPoint& hit) const;  ///< 1/sr, of the direction from `p` to `hit` on the surface

 private:
  enum class Kind { sphere, disk, cylinder };
  struct ObjectPoint {
    Vec3d p, n;  ///< n outward, along +z on a disk
  };

  ObjectPoint object_sample(Vec2 u) const;
  Vec3d object_normal(Vec3d object_p) const;
  Vec2 uv(Vec3d object_p) const;
  Vec3d to_world(Vec3d p) const;
  Vec3d to_object(Vec3d p) const;
  Vec3d world_normal(Vec3d n) const;              ///< by the inverse transpose, not normalised
  double world_area_scale(Vec3d object_n) const;  ///< world area per object area
  std::optional<double> cone_height(const RoundedPoint& p) const;
  EmitterSample cone_sample(Vec3d to_center, double h, Vec3d p, Vec2 u) const;
  double measure_area() const;

  Kind kind_;
  double radius_ = 1, inner_radius_ = 0, z_min_ = -1, z_max_ = 1, phi_max_;
  Transform::Matrix map_, inverse_;
  Bounds3 box_;         ///< in the world
  double determinant_;  ///< absolute, of the linear part
  double sign_;         ///< of the outer normal against the object's own
  double object_area_, area_, projected_area_;
  double cone_radius_ = 0;  ///< in the world; 0: no cone sampling
};

}  // namespace tyndall
