/// On which side of an edge a line passes, without rounding errors and without ties.
#pragma once

#include "surface/shape_root.h"

namespace tyndall {

/// A signed area whose sign was decided exactly.
struct EdgeSide {
  int sign;      ///< -1 or +1; 0 only when the edge is parallel to the ray
  double value;  ///< its size, rounded, of that sign or 0
};

/// Sign of det[a - o, b - o, d]: on which side of the directed edge ab the ray passes. The side of ba is the opposite,
/// always. A ray that meets the edge is moved aside by an infinitesimal (e, e^2, e^3), the same for all edges
/// [Edelsbrunner & Muecke 1990, Simulation of Simplicity], so the answers are those of one true line that meets no edge.
EdgeSide edge_side(const ShapeRay& ray, Vec3d a, Vec3d b);

}  // namespace tyndall
