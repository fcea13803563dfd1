/// Images as a render leaves them, of a truth and of noise that are known.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "math/rng.h"
#include "tyndall/image.h"

namespace tyndall::test {

/// Standard normal, by Box and Muller.
inline float normal(Rng& rng) { return std::sqrt(-2 * std::log(1 - rng.uniform())) * std::cos(6.2831853f * rng.uniform()); }

/// One channel's truth, and the standard deviation of a sample.
using OfPixel = std::function<float(int x, int y)>;

inline OfPixel always(float value) {
  return [value](int, int) { return value; };
}

struct FakeRender {
  int width = 48, height = 40, samples = 16;
  std::uint64_t seed = 1;

  Image image() const {
    Image image;
    image.data = image.display = {0, 0, width, height};
    image.attributes["tyndall/samples"] = samples;
    return image;
  }

  /// Adds the channel and its replicate: means of normal samples over all and over the even ones.
  void add(Image& image, const std::string& name, const OfPixel& truth, const OfPixel& deviation) const {
    Rng rng(seed * 1000 + image.channels.size());
    std::vector<float> all(image.data.size()), even(image.data.size());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double sum = 0, even_sum = 0;
        for (int s = 0; s < samples; ++s) {
          const double value = static_cast<double>(truth(x, y)) + static_cast<double>(deviation(x, y) * normal(rng));
          sum += value;
          if (s % 2 == 0) even_sum += value;
        }
        const std::size_t i = image.data.index(x, y);
        all[i] = static_cast<float>(sum / samples);
        even[i] = static_cast<float>(even_sum / (samples - samples / 2));
      }
    }
    image.add_channel(name).values = all;
    image.add_channel("Replicate." + name).values = even;
  }

  void add_rgb(Image& image, const std::string& prefix, const OfPixel& truth, const OfPixel& deviation) const {
    for (const char* suffix : {"R", "G", "B"}) add(image, prefix + suffix, truth, deviation);
  }
};

}  // namespace tyndall::test
