/// The procedural cloud of pbrt-v4's CloudMedium.
#pragma once

#include "tyndall/math.h"
#include "tyndall/scene.h"

namespace tyndall {

/// Density in [0, 1] at a point of medium space, without regard to the bounds [PBR book 4th ed., sec. 11.4.4].
float cloud_density(const CloudMedium& cloud, Vec3 p);

}  // namespace tyndall
