/// Float images with named channels: what a render gives, and what an image file holds.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tyndall/math.h"

namespace tyndall {

/// Pixels [x0, x1) x [y0, y1), y downward.
struct PixelBounds {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  std::size_t size() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  /// Of a pixel inside, row by row.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x - x0);
  }
  bool operator==(const PixelBounds&) const = default;
};

/// "x0,x1,y0,y1", as --crop takes it.
std::string crop_text(const PixelBounds& crop);

/// CIE 1931 xy of the three primaries and the white point.
struct Chromaticities {
  Vec2 red{0.64f, 0.33f}, green{0.30f, 0.60f}, blue{0.15f, 0.06f}, white{0.3127f, 0.3290f};
};

/// One plane of floats over the data window, row by row.
struct Channel {
  std::string name;           ///< as in OpenEXR: "R", "Albedo.G", "Variance.R", "SampleCount" ...
  std::vector<float> values;  ///< data window width * height
};

using Attribute = std::variant<int, float, double, std::string, std::array<float, 16>>;

/// An image of any set of channels. `data` is the part that has pixels; `display` the full frame.
struct Image {
  PixelBounds data, display;
  std::vector<Channel> channels;
  std::map<std::string, Attribute> attributes;
  std::optional<Chromaticities> chromaticities;

  int width() const { return data.width(); }
  int height() const { return data.height(); }
  Channel& add_channel(std::string name);               ///< zero-filled; returns the new channel
  const Channel* find(std::string_view channel) const;  ///< null when absent
  /// Null when absent, or not of that type.
  template <typename T>
  const T* attribute(const std::string& name) const {
    const auto found = attributes.find(name);
    return found == attributes.end() ? nullptr : std::get_if<T>(&found->second);
  }
  Rgb rgb(int x, int y) const;  ///< R G B (or Y) at data-window-relative x, y; throws Error when the image has neither
};

}  // namespace tyndall
