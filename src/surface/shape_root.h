/// What every shape answers: where a ray meets it, and what the surface is like there.
#pragma once

#include <array>

#include "surface/shape_map.h"

namespace tyndall {

/// One meeting of a ray o + t d with a shape, in the space the shape was placed in.
struct ShapeRoot {
  double t;
  int facing;     ///< sign of dot(d, ng) for the shape's own, unflipped ng: cross(dpdu, dpdv), or of a triangle's edges
  double cosine;  ///< |cos| between the ray and the normal; may be rough
  double u, v;    ///< surface parameters: triangle weights 1 and 2; patch (u, v); quadric, see shape_quadric.h
};

/// No shape meets a line more than twice.
struct ShapeRoots {
  std::array<ShapeRoot, 2> root;
  int count = 0;
  void push(const ShapeRoot& r) { root[static_cast<std::size_t>(count++)] = r; }
  const ShapeRoot* begin() const { return root.data(); }
  const ShapeRoot* end() const { return root.data() + count; }
};

struct ShapeRay {
  Vec3d o, d;
};

/// The surface at given parameters, in the space the shape was placed in.
struct ShapeSurface {
  Vec3d p;
  Vec3d ng, ns;  ///< unit, pbrt's orientation
  Vec3d dpdu;    ///< perpendicular to ns
  Vec2 uv;
  double error = 0;  ///< bound on the distance from p to the plane that rays are tested against
};

}  // namespace tyndall
