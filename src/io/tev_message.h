/// Messages of the viewer tev's protocol for programs that render: little-endian, each its length (these four bytes included),
/// a type, its fields; strings end in 0.
#pragma once

#include <string>

#include "tyndall/image.h"

namespace tyndall {

/// Type 4: an image of this name, size and channels, black; one of the same name is replaced.
std::string tev_create(const std::string& name, const Image& image);

/// Type 6: the values of all channels in `tile`, relative to the data window.
std::string tev_update(const std::string& name, const Image& image, const PixelBounds& tile);

}  // namespace tyndall
