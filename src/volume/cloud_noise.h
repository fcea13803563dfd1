/// The procedural cloud of pbrt-v4's CloudMedium.
#pragma once

#include "tyndall/math.h"
#include "tyndall/scene.h"

namespace tyndall {

/// Perlin's improved gradient noise [Perlin 2002] with his permutation, repeating every 256 units; in about [-1, 1].
float perlin_noise(Vec3 p);

/// Density in [0, 1] at a point of medium space, without regard to the bounds [PBR book 4th ed., sec. 11.4.4].
float cloud_density(const CloudMedium& cloud, Vec3 p);

}  // namespace tyndall
