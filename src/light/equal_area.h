/// pbrt's square environment maps: the equal-area octahedral mapping of the sphere [Clarberg 2008].
#pragma once

#include <array>

#include "tyndall/math.h"

namespace tyndall {

/// Unit direction of a point of [0, 1]^2; (0.5, 0.5) is +z, the corners are -z, x grows with p.x.
Vec3 equal_area_square_to_sphere(Vec2 p);
/// Inverse of the above; `w` has unit length.
Vec2 equal_area_sphere_to_square(Vec3 w);

/// The point of [0, 1]^2 that stands for `p` anywhere in the plane: across an edge the square goes on upside down.
Vec2 equal_area_wrapped(Vec2 p);

/// The texel of an n x n map that holds texel (x, y), which may lie one beyond an edge: across an edge the square goes on
/// upside down.
std::array<int, 2> equal_area_neighbor(int x, int y, int n);

}  // namespace tyndall
