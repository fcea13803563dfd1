/// Gradient noise, of procedural clouds and textures.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

/// Perlin's improved gradient noise [Perlin 2002] with his permutation, repeating every 256 units; in about [-1, 1].
float perlin_noise(Vec3 p);

}  // namespace tyndall
