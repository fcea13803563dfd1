/// A procedural plume of smoke.
#pragma once

#include <cstdint>

#include "tyndall/volume_io.h"

namespace tyndall {

/// Rises from (0, 0, 0) to about y = 4.4 m, some 2.5 m wide at its head; densities in [0, 1].
FogGrid smoke_plume(std::uint64_t seed);

/// Where the middle of the plume is at height y, and how far it reaches from there.
Vec3 plume_axis(float y);
float plume_radius(float y);
inline constexpr float kPlumeHeight = 4.4f;

}  // namespace tyndall
