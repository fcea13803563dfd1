/// Does a render agree with the reference of its case, layer by layer?
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// Three channels at most that are tested as one picture.
struct Layer {
  std::string name;                     ///< "RGB", "A", "Albedo", "Z" ...
  std::array<std::string, 3> channels;  ///< empty: none
};

/// The layers of an image's channels, variances left out.
std::vector<Layer> layers_of(const Image& image);

/// One test of a case. For "bytes" and "health" only the first three say something.
struct LayerTest {
  std::string what;
  bool same = false;
  std::string verdict{};  ///< one line
  std::size_t alarms = 0, blocks = 0;
  double worst_p = 1;
  std::array<double, 3> mean_difference{};  ///< relative to the reference, by channel
  std::array<double, 3> mean_error{};       ///< one standard error of it
  double uniformity_p = 1;
};

/// Tests every layer, each at `level`: the chance that one that agrees is said to differ. Both images are
/// RunMeans::result. A layer that one of them lacks differs. Throws Error (usage) when the sizes differ.
std::vector<LayerTest> judge(const Image& render, const Image& reference, double level);

/// Mean over pixels of one layer's channels, for people.
double layer_mean(const Image& image, const Layer& layer);

}  // namespace tyndall
