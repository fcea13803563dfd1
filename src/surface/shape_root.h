/// What every shape answers: where a ray meets it, and what the surface is like there.
#pragma once

#include <array>

#include "math/small_vector.h"
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
  float t_min = -kInfinity, t_max = kInfinity;  ///< roots beyond may be left out
};

/// From where a shape is seen: from a point, or along a direction from infinity.
struct ShapeView {
  Vec3d from;  ///< the point; or the direction toward the shape
  bool along = false;
};
/// Points whose convex hull, as it is seen, holds the image of a primitive and is little larger.
using ShapeOutline = SmallVector<Vec3d, 16>;

/// The surface at given parameters, in the space the shape was placed in.
struct ShapeSurface {
  Vec3d p;
  Vec3d ng, ns;  ///< unit, pbrt's orientation
  Vec3d dpdu;    ///< perpendicular to ns
  Vec2 uv;
  double error = 0;  ///< bound on the distance from p to the plane that rays are tested against
};

/// How the surface goes on about a point, as pbrt defines it: what bump mapping and texture footprints need.
struct ShapeTangents {
  Vec3d dpdu, dpdv;                  ///< of the surface itself
  Vec3d shading_dpdu, shading_dpdv;  ///< perpendicular to the shading normal
  Vec3d dndu, dndv;                  ///< of the shading normal
};

/// What a surface encloses, by the divergence theorem: integrals of (p - center) . n / 3, of n, and of 1 over it.
struct Enclosure {
  double volume = 0;
  Vec3d vector_area;
  double area = 0;

  void add_triangle(Vec3d a, Vec3d b, Vec3d c, int orientation) {
    const Vec3d n = cross(b - a, c - a) * (0.5 * orientation);
    volume += dot(a, n) / 3;
    vector_area = vector_area + n;
    area += length(n);
  }
  void add(const Enclosure& other) {
    volume += other.volume;
    vector_area = vector_area + other.vector_area;
    area += other.area;
  }
};

}  // namespace tyndall
