#include "tyndall/deep_image.h"

namespace tyndall {

Image flatten(const DeepImage& deep) {
  Image image;
  image.data = deep.data;
  image.display = deep.display;
  image.attributes = deep.attributes;
  image.chromaticities = deep.chromaticities;
  for (const char* name : {"R", "G", "B", "A"}) image.add_channel(name);
  const DeepPixelSample* sample = deep.samples.data();
  for (std::size_t i = 0; i < deep.counts.size(); ++i) {
    std::array<double, 4> sum{};
    double passing = 1;
    for (const DeepPixelSample* end = sample + deep.counts[i]; sample < end; ++sample) {
      for (std::size_t k = 0; k < 4; ++k) sum[k] += passing * static_cast<double>(sample->rgba[k]);
      passing *= 1 - static_cast<double>(sample->rgba[3]);
    }
    for (std::size_t k = 0; k < 4; ++k) image.channels[k].values[i] = static_cast<float>(sum[k]);
  }
  return image;
}

}  // namespace tyndall
