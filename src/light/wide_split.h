/// How the lights of a wide node are divided among its children: the surface area orientation heuristic on buckets.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "light/build_light.h"

namespace tyndall {

/// Lights per child in order, of a node; 0: no such child.
using Division = std::array<std::uint32_t, 8>;

/// Reorders the lights so that the children's are consecutive.
Division divide(std::span<BuildLight> lights);

}  // namespace tyndall
