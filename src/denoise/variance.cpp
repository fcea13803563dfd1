#include "denoise/variance.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int kAround = 4;           ///< radius of what a firefly is held against
constexpr float kMostTimes = 10.0f;  ///< of the mean around it

float luminance(const ColorPlanes& color, int x, int y) {
  return (color[0].at(x, y) + color[1].at(x, y) + color[2].at(x, y)) * (1.0f / 3);
}

}  // namespace

void pool_variance(Halves& halves, int radius, ThreadPool& pool) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto raw = [&](int x, int y) { return halves.raw_variance(c, x, y); };
    halves.variance[c] = box_mean(make_plane(halves.width(), halves.height(), pool, raw), radius, pool);
  }
}

void take_out_fireflies(Halves& halves, ThreadPool& pool) {
  const int width = halves.width(), height = halves.height();
  std::array<PaddedPlane, 2> brightness;
  for (std::size_t h = 0; h < 2; ++h) {
    brightness[h] = make_plane(width, height, pool, [&](int x, int y) { return luminance(halves.values[h], x, y); });
  }
  // Sums over both halves around each pixel, of which its own value is a part.
  const PaddedPlane mean =
      box_mean(make_plane(width, height, pool,
                          [&](int x, int y) { return std::abs(brightness[0].at(x, y)) + std::abs(brightness[1].at(x, y)); }),
               kAround, pool);
  constexpr float kPixels = (2 * kAround + 1) * (2 * kAround + 1), kValues = 2 * kPixels;
  for (std::size_t h = 0; h < 2; ++h) {
    pool.for_each(static_cast<std::size_t>(height), 16, [&](std::size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < width; ++x) {
        const float own = std::abs(brightness[h].at(x, y));
        const float others = std::max(mean.at(x, y) * kPixels - own, 0.0f) / (kValues - 1);
        const float other_half = std::abs(brightness[1 - h].at(x, y));
        if (own <= kMostTimes * std::max(others, other_half)) continue;
        const float keep = others / own;
        for (PaddedPlane& plane : halves.values[h]) plane.at(x, y) *= keep;
      }
    });
    for (PaddedPlane& plane : halves.values[h]) plane.extend();
  }
}

}  // namespace tyndall
