/// Parts of describe(): how values read, and the summary of a scene.
#pragma once

#include <string>

#include "tyndall/io.h"
#include "tyndall/math.h"

namespace tyndall {

std::string number_text(double value);           ///< as short as 6 significant digits allow
std::string bounds_text(const Bounds3& bounds);  ///< "(x y z) to (x y z)", or "empty"

/// What a .pbrt file holds, from read_scene: camera, film, settings, counts, bounds, media, lights.
Description describe_scene(const std::string& path);

}  // namespace tyndall
