/// What the halves of a film's samples tell of its noise.
#include <algorithm>
#include <vector>

#include "session/block_grid.h"
#include "session/film_buffer.h"

namespace tyndall {
namespace {

constexpr double kRelativeEpsilon = 0.01;  ///< of relMSE, as everywhere

/// E[(a-b)^2] = v/even + v/odd for a variance of v a sample, so the mean of all has (a-b)^2 even odd / samples^2.
/// A single sample has no variance estimate; its square stands in as a pessimistic value.
float variance_factor(int samples) {
  const int even = even_of(samples), odd = samples - even;
  return odd > 0 ? static_cast<float>(even) * odd / (static_cast<float>(samples) * samples) : 1.0f;
}

}  // namespace

Rgb FilmBuffer::difference(std::size_t pixel, std::size_t offset, int samples) const {
  const int even = even_of(samples), odd = samples - even;
  Rgb difference;  // in double first: the halves are nearly equal
  for (int k = 0; k < 3; ++k) {
    difference[k] = static_cast<float>(sum(pixel, offset + kEven + static_cast<std::size_t>(k)) / even -
                                       (odd > 0 ? sum(pixel, offset + kOdd + static_cast<std::size_t>(k)) / odd : 0.0));
  }
  return to_film_space(difference);
}

/// `offset`: of sums by halves.
void FilmBuffer::store_variance(Image& image, const std::string& name, std::size_t offset, const SampleCounts& samples) const {
  const std::size_t first = image.channels.size();
  for (const char* suffix : {"R", "G", "B"}) image.add_channel("Variance." + name + suffix);
  const std::size_t pixels = image.channels[first].values.size();
  for (std::size_t i = 0; i < pixels; ++i) {
    const float factor = variance_factor(samples.of(i));
    const Rgb d = difference(i, offset, samples.of(i));
    for (int k = 0; k < 3; ++k) image.channels[first + k].values[i] = d[k] * d[k] * factor;
  }
}

double FilmBuffer::estimated_relmse(const SampleCounts& samples) const {
  if (samples.least() < 2) return kInfinity;
  const BlockGrid grid(crop_);
  std::vector<BlockNoise> blocks;
  for (std::size_t b = 0; b < grid.size(); ++b) {
    const PixelBounds pixels = grid.pixels(b);
    blocks.push_back(noise(pixels, samples.of(crop_.index(pixels.x0, pixels.y0))));
  }
  return mean_error(blocks);
}

BlockNoise FilmBuffer::noise(const PixelBounds& block, int samples) const {
  BlockNoise noise{.pixels = static_cast<double>(block.size()), .samples = samples};
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) noise.error += samples * estimated_relmse(crop_.index(x, y), samples);
  }
  return noise;
}

double FilmBuffer::estimated_relmse(std::size_t pixel, int samples) const {
  const Rgb d = difference(pixel, kEven, samples);
  Rgb sums;
  for (std::size_t k = 0; k < 3; ++k)
    sums[static_cast<int>(k)] = static_cast<float>((sum(pixel, kEven + k) + sum(pixel, kOdd + k)) / samples);
  const Rgb mean = to_film_space(sums);
  double total = 0;
  for (int k = 0; k < 3; ++k) {
    // E[mean^2] is larger than its square by the variance; left in, that would hide the error of dark pixels.
    const double variance = double{d[k]} * d[k] * variance_factor(samples), square = double{mean[k]} * mean[k] - variance;
    total += variance / (std::max(square, 0.0) + kRelativeEpsilon);
  }
  return total / 3;
}

}  // namespace tyndall
