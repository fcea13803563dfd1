/// pbrt's square environment maps: the equal-area octahedral mapping of the sphere [Clarberg 2008].
#pragma once

#include "tyndall/math.h"

namespace tyndall {

/// Unit direction of a point of [0, 1]^2; (0.5, 0.5) is +z, the corners are -z, x grows with p.x.
Vec3 equal_area_square_to_sphere(Vec2 p);
/// Inverse of the above; `w` has unit length.
Vec2 equal_area_sphere_to_square(Vec3 w);

}  // namespace tyndall
