/// Small pictures for the tests of src/report.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall::test {

/// R, G, B (or other channels) of value(x, y, channel number).
inline Image picture(int width, int height, const std::function<double(int, int, int)>& value,
                     const std::vector<std::string>& channels = {"R", "G", "B"}) {
  Image image;
  image.data = image.display = {0, 0, width, height};
  for (std::size_t k = 0; k < channels.size(); ++k) {
    Channel& channel = image.add_channel(channels[k]);
    for (int i = 0; i < width * height; ++i) {
      channel.values[static_cast<std::size_t>(i)] = static_cast<float>(value(i % width, i / width, static_cast<int>(k)));
    }
  }
  return image;
}

/// Equal to a fraction of their size (doctest's Approx allows that fraction of 1 as well).
inline bool close(double a, double b, double fraction) {
  return std::abs(a - b) <= fraction * std::max(std::abs(a), std::abs(b));
}

inline Image flat(int width, int height, double r, double g, double b) {
  return picture(width, height, [&](int, int, int k) { return k == 0 ? r : (k == 1 ? g : b); });
}

/// `image` with Variance.R, .G and .B of `variance` everywhere.
inline Image with_variance(Image image, float variance) {
  for (const char* name : {"Variance.R", "Variance.G", "Variance.B"}) {
    for (float& v : image.add_channel(name).values) v = variance;
  }
  return image;
}

}  // namespace tyndall::test
