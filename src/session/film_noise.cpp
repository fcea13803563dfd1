/// What the halves of a film's samples tell of its noise.
#include <algorithm>
#include <vector>

#include "session/block_grid.h"
#include "session/film_buffer.h"
#include "tyndall/relative_error.h"

namespace tyndall {
namespace {

/// E[(a-b)^2] = v/even + v/odd for a variance of v a sample, so the mean of all has (a-b)^2 even odd / samples^2.
/// A single sample has no variance estimate; its square stands in as a pessimistic value.
float variance_factor(int samples) {
  const int even = even_of(samples), odd = samples - even;
  return odd > 0 ? static_cast<float>(even) * odd / (static_cast<float>(samples) * samples) : 1.0f;
}

/// Of what `value` says of the up to eight pixels of the block around its number `at`; of that itself where it is alone.
template <typename Value>
double mean_around(int at, const PixelBounds& block, const Value& value) {
  const int x = at % block.width(), y = at / block.width();
  double sum = 0;
  int count = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, block.height() - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, block.width() - 1); ++u) {
      const int i = v * block.width() + u;
      if (i != at) sum += value(static_cast<std::size_t>(i)), ++count;
    }
  }
  return count > 0 ? sum / count : value(static_cast<std::size_t>(at));
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
void FilmBuffer::store_variance(Image& image, const std::string& name, std::size_t offset, int samples) const {
  const std::size_t first = image.channels.size();
  for (const char* suffix : {"R", "G", "B"}) image.add_channel("Variance." + name + suffix);
  const std::size_t pixels = image.channels[first].values.size();
  const float factor = variance_factor(samples);
  for (std::size_t i = 0; i < pixels; ++i) {
    const Rgb d = difference(i, offset, samples);
    for (int k = 0; k < 3; ++k) image.channels[first + k].values[i] = d[k] * d[k] * factor;
  }
}

double FilmBuffer::estimated_relmse(int samples) const {
  if (samples < 2) return kInfinity;
  const BlockGrid grid(crop_);
  std::vector<BlockNoise> blocks;
  for (std::size_t b = 0; b < grid.size(); ++b) {
    blocks.push_back(noise(grid.pixels(b), samples));
  }
  return mean_error(blocks);
}

/// The noise that makes a pixel bright must not hide in that brightness: as far as it explains how the pixel differs from those
/// around it, its square is theirs.
BlockNoise FilmBuffer::noise(const PixelBounds& block, int samples) const {
  std::vector<PixelNoise> pixels;
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) pixels.push_back(noise_of(crop_.index(x, y), samples));
  }
  BlockNoise noise{.pixels = static_cast<double>(pixels.size())};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto around = [&](std::array<double, 3> PixelNoise::*value) {
        return mean_around(static_cast<int>(i), block, [&](std::size_t j) { return (pixels[j].*value)[k]; });
      };
      const double v = pixels[i].variance[k], off = pixels[i].mean[k] - around(&PixelNoise::mean);
      const double doubt = v > 0 ? std::min(1.0, v / (off * off)) : 0.0;
      const double square = pixels[i].square[k] + doubt * (around(&PixelNoise::square) - pixels[i].square[k]);
      noise.error += v / (std::max(square, 0.0) + kRelativeEpsilon) / 3;
    }
  }
  return noise;
}

/// E[mean^2] is larger than its square by the variance; left in, that would hide the error of dark pixels.
FilmBuffer::PixelNoise FilmBuffer::noise_of(std::size_t pixel, int samples) const {
  const Rgb d = difference(pixel, kEven, samples);
  Rgb sums;
  for (std::size_t k = 0; k < 3; ++k)
    sums[static_cast<int>(k)] = static_cast<float>((sum(pixel, kEven + k) + sum(pixel, kOdd + k)) / samples);
  const Rgb mean = to_film_space(sums);
  PixelNoise noise;
  for (int k = 0; k < 3; ++k) {
    const auto channel = static_cast<std::size_t>(k);
    noise.mean[channel] = double{mean[k]};
    noise.variance[channel] = double{d[k]} * d[k] * variance_factor(samples);
    noise.square[channel] = double{mean[k]} * mean[k] - noise.variance[channel];
  }
  return noise;
}

}  // namespace tyndall
