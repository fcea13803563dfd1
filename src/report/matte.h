/// Mattes taken out of an image by the names of what they cover.
#pragma once

#include <string>
#include <vector>

#include "tyndall/cryptomatte.h"

namespace tyndall {

/// Somebody that a layer knows.
struct MatteEntry {
  std::string layer, name;
  std::uint32_t id = 0;
  double coverage = 0;  ///< mean over the image
};
/// All that the layers' manifests name, layer by layer, by names. Throws Error (scene), naming `path`, for an image without
/// layers, and for a manifest that is damaged.
std::vector<MatteEntry> list_mattes(const Image& image, const std::string& path);

/// R, G and B: the coverage of all that have one of `names` in a layer; of the first layer that knows them all if `layer` is
/// empty. Throws Error: scene as list_mattes, usage for names that are not there, with those that are.
Image take_matte(const Image& image, const std::vector<std::string>& names, const std::string& layer, const std::string& path);

}  // namespace tyndall
