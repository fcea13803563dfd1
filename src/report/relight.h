/// Light groups mixed anew: each group's light times a factor, in an image that was rendered with groups.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

struct GroupFactor {
  std::string group;
  Rgb factor{1.0f};  ///< >= 0, of R, G and B of the image
};

/// "key=1.5" or "sky=0.3,0.3,0.5". Throws Error (usage).
GroupFactor parse_group_factor(const std::string& text);

struct Relit {
  Image image;
  std::vector<std::string> left_out;  ///< channels that no factors can be applied to: "SurfaceDirect" ...
};

/// Groups that `factors` does not name stay as they are. R G B become the sum of the groups, which are scaled, and so do their
/// replicates; the variance of that sum is known from replicates, else bounded from above (docs/relighting.md). The light split
/// stays only where all groups have the same factor; the rest of the image and its attributes are kept, and "tyndall/relight"
/// names the factors.
///
/// Throws Error: scene, naming `name`, for an image without groups and for slices; usage for a group that the image does not
/// have, with those that it has, and for one that is named twice.
Relit relight(Image image, std::span<const GroupFactor> factors, const std::string& name = "the image");

}  // namespace tyndall
