/// Light groups of a filtered picture.
#pragma once

#include <string>
#include <vector>

#include "denoise/plane.h"
#include "tyndall/image.h"

namespace tyndall {

/// Groups are filtered each for itself, as all light at once: by less than is known of the picture, whose components have
/// features of their own. So they only tell how the picture is shared out: the channels of `prefixes` are scaled, pixel by
/// pixel, to the sum `total`.
void share_out(const ColorPlanes& total, const std::vector<std::string>& prefixes, Image& image);

}  // namespace tyndall
