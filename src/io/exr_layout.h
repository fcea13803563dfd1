/// How an image lies in an OpenEXR file: which channels are halves, and what stands in which part.
#pragma once

#include <string>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/image_format.h"

namespace tyndall {

/// Of the channels of a render, whether this one is a colour that 16 bits are enough for.
bool is_half_channel(const std::string& name);

/// The image as a file of halves will give it back: rounded to nearest, clamped to what a half can hold.
Image rounded_to_halves(Image image);

/// Channels of a part, by their places in the image.
struct ExrPart {
  std::string name;
  std::vector<std::size_t> channels;
};
/// "rgba" first, then a part for each group ("Albedo" for Albedo.R, .G, .B), in the image's order; with `several` false one
/// part of all.
std::vector<ExrPart> parts_of(const Image& image, bool several);

}  // namespace tyndall
