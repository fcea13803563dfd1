/// Where the error is, as a picture.
#pragma once

#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// The relative squared error (x - r)^2 / (r^2 + 0.01) of each pixel, averaged over R, G and B, in false colours: black
/// up to 1e-4 (1 % off), then on a logarithmic scale violet (2e-3), red (3e-2), orange (0.6) and pale yellow from 10 on.
/// Pixels that are not finite are green. R, G, B are linear, to be written by write_png at exposure 0.
/// Throws Error: usage when the sizes differ, scene when a channel is missing.
Image error_picture(const Image& image, const Image& reference);
/// The same over any channels that both images have.
Image error_picture(const Image& image, const Image& reference, const std::vector<std::string>& channels);

}  // namespace tyndall
