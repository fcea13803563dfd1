/// Room for what a render writes, looked at before it begins and not after it.
#pragma once

#include <cstdint>
#include <string>

#include "tyndall/scene.h"

namespace tyndall::cli {

/// That are rendered: the settings' crop, else the film's.
std::uint64_t pixels_of(const Scene& scene);

/// Throws Error (output) when the disk of `output`, or the limit on the size of files, could not hold the image of `scene`
/// as it is without compression; with `checkpoints` also these: while one is replaced there are two, and at the end one
/// stands beside the image.
void require_room(const std::string& output, const Scene& scene, bool checkpoints);

}  // namespace tyndall::cli
