/// OpenEXR files. With exr_*.cpp the only door to that library; writing is write_exr in tyndall/io.h.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// An image and how its file stores it.
struct ExrFile {
  Image image;                             ///< every channel as float; UINT above 2^24 loses its lowest bits
  std::vector<std::string> channel_types;  ///< "half", "float" or "uint", one a channel
  std::string compression;                 ///< "zip", "piz" ...
  std::string storage;                     ///< "scanlines" or "tiles"
  int parts = 1;
};

/// Threads that the library may use to pack or unpack an image of this many values, made available to it; 0: the caller's
/// alone. limit_image_threads() in tyndall/io.h sets the most.
int exr_threads(std::size_t values);

/// True when the file begins as OpenEXR files do; false also when it cannot be opened.
bool is_exr(const std::string& path);

/// Reads a flat file, level 0 when it has several; of several parts, which must have one data window, the channels of all.
/// Sizes are checked against the file's before anything is allocated. Throws Error (scene) for what is missing, deep, cut
/// off, damaged or too large.
ExrFile read_exr(const std::string& path);

/// True when the file at `path` holds exactly these channels and, bit for bit, these pixels. Throws Error (scene).
bool exr_holds(const std::string& path, const Image& image);
/// The same but for the values, all of which are read: what can be said of lossy packing.
bool exr_has_pixels_of(const std::string& path, const Image& image);

}  // namespace tyndall
