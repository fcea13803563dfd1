/// Images with samples in depth, for compositing among what others have rendered.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// A volume where z < z_back, else a surface: light that comes from there, and the share of what is behind that it hides.
struct DeepPixelSample {
  float z = 0, z_back = 0;      ///< scene units along the viewing axis; of a spherical camera from its center
  std::array<float, 4> rgba{};  ///< premultiplied
};

/// Samples pixel by pixel, in each sorted by depth, none overlapping another.
struct DeepImage {
  PixelBounds data, display;
  std::vector<std::uint32_t> counts;     ///< of samples, data window width * height
  std::vector<DeepPixelSample> samples;  ///< all of them, in the order of the pixels
  std::map<std::string, Attribute> attributes;
  std::optional<Chromaticities> chromaticities;
};

/// Of light behind everything: no surface, at a depth that is farther than any.
inline constexpr float kDeepBackground = 1e10f;

/// Channels R G B A of what the samples make together, front to back: c = c_front + (1 - a_front) c_back, a alike
/// [Porter and Duff 1984].
Image flatten(const DeepImage& deep);

/// Write a deep OpenEXR file of scan lines with channels R G B A Z ZBack, floats: to a temporary name, read back and compared,
/// renamed. Throws Error (output) and leaves an existing file as it was.
void write_deep_exr(const DeepImage& image, const std::string& path);
/// Read one; R G B A and Z must be there, where ZBack is not it is Z. Throws Error (scene).
DeepImage read_deep_exr(const std::string& path);

/// Whether the file is a deep OpenEXR one; false also when it cannot be opened.
bool is_deep_exr(const std::string& path);

}  // namespace tyndall
