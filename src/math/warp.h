/// Maps from the unit square to disks, hemispheres, spheres and cones, each with its density right beneath it.
/// `u` is in [0, 1)^2; directions are unit vectors around +z.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

/// Uniform on the unit disk, low distortion [Shirley and Chiu 1997].
Vec2 square_to_concentric_disk(Vec2 u);
float concentric_disk_pdf(Vec2 p);  ///< 1/area

/// Uniform on the hemisphere z >= 0.
Vec3 square_to_uniform_hemisphere(Vec2 u);
float uniform_hemisphere_pdf(Vec3 w);  ///< 1/sr

/// Proportional to cos theta on the hemisphere z >= 0 [Malley 1988].
Vec3 square_to_cosine_hemisphere(Vec2 u);
float cosine_hemisphere_pdf(Vec3 w);  ///< 1/sr

/// Uniform on the sphere.
Vec3 square_to_uniform_sphere(Vec2 u);
float uniform_sphere_pdf(Vec3 w);  ///< 1/sr

/// Uniform in the cone cos theta >= 1 - `h`, 0 < h <= 2. Its size is given as h = 1 - cos theta_max, which keeps
/// its digits when the cone is narrow: h = 2 sin^2(theta_max / 2).
Vec3 square_to_uniform_cone(Vec2 u, float h);
float uniform_cone_pdf(Vec3 w, float h);  ///< 1/sr

}  // namespace tyndall
