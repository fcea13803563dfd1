/// Closed convex meshes as what they are: the common part of half-spaces.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "surface/shape_mesh.h"

namespace tyndall {

/// What lies within all of a mesh's planes. Whether it holds a point does not depend on the ray that asks: all rays from there
/// see the same signs. From the mesh itself it differs by the rounding of vertices at most.
class ConvexBoundary {
 public:
  /// Nothing where the mesh is open, not convex, degenerate, or of more planes than are quick to ask one by one.
  static std::optional<ConvexBoundary> of(const PlacedMesh& triangles);

  /// Where the line is within; `cosine` as in ShapeRoot.
  struct Passage {
    double enters, leaves;
    double enters_cosine, leaves_cosine;
  };
  std::optional<Passage> passage(const ShapeRay& ray) const;

 private:
  struct Plane {
    Vec3d n;   ///< unit, outward
    double h;  ///< its distance from center_
  };
  explicit ConvexBoundary(Vec3d center) : center_(center) {}
  bool holds(const std::array<Vec3d, 3>& triangle, double rounding) const;
  /// Whether a plane has the whole triangle, to rounding.
  bool has(const std::array<Vec3d, 3>& triangle, double rounding) const;

  Vec3d center_;  ///< within; planes are about it, so that far from the world's origin no precision is lost
  std::vector<Plane> planes_;
};

}  // namespace tyndall
