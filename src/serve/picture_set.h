/// The pictures that an image's channels make, for a page to show.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// One channel, or three, which are shown as R, G and B.
struct ServedPicture {
  /// `error`: relative squared errors; these, and numbers of samples, are for false colours.
  enum class Kind { light, error, samples };
  std::string name;
  Kind kind = Kind::light;
  std::shared_ptr<const Image> image;
  std::vector<std::size_t> channels;
};

/// R G B as "rendered", or as "denoised" beside "rendered" where the image has noisy.R; then the AOVs by name, in the image's
/// order. Left out: A, replicates, exact sums, and what is no picture.
std::vector<ServedPicture> pictures_of(const std::shared_ptr<const Image>& image);

/// Of each channel the plane of half floats, row by row, low byte first.
std::string halves_of(const ServedPicture& picture);

}  // namespace tyndall
