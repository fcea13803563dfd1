/// The image at the end of a render: hours of work that must end up somewhere.
#pragma once

#include <cstdint>
#include <string>

#include "tyndall/image.h"

namespace tyndall::cli {

/// Throws Error (output), before anything is rendered, when a file at `path` could not hold `bytes`.
void check_room(const std::string& path, std::uint64_t bytes);

/// Writes `image` to `path`, .exr or .png by its ending. When that fails it tries again a few times, since disks get
/// cleared, then writes to the folder for temporary files, the home folder or the current one, and throws Error
/// (output) that says where the image is.
void save_image(const Image& image, const std::string& path);

}  // namespace tyndall::cli
