#include "denoise/fireflies.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int kAround = 4;           ///< radius of what a value is held against
constexpr float kMostTimes = 10.0f;  ///< of the mean around it
constexpr int kLost = 6;             ///< radius over which lost light is pooled, twice
constexpr float kPixels = (2 * kAround + 1) * (2 * kAround + 1), kValues = 2 * kPixels;

/// Of both halves: how bright they are.
class Brightness {
 public:
  Brightness(const Halves& halves, ThreadPool& pool) {
    const int width = halves.width(), height = halves.height();
    for (std::size_t h = 0; h < 2; ++h) {
      halves_[h] = make_plane(width, height, pool, [&](int x, int y) {
        const ColorPlanes& v = halves.values[h];
        return std::abs(v[0].at(x, y) + v[1].at(x, y) + v[2].at(x, y)) * (1.0f / 3);
      });
    }
    mean_ = box_mean(make_plane(width, height, pool, [&](int x, int y) { return halves_[0].at(x, y) + halves_[1].at(x, y); }),
                     kAround, pool);
  }

  float of(std::size_t half, int x, int y) const { return halves_[half].at(x, y); }
  /// Mean of all values around but this one.
  float around(std::size_t half, int x, int y) const {
    return std::max(mean_.at(x, y) * kPixels - of(half, x, y), 0.0f) / (kValues - 1);
  }
  bool stands_out(std::size_t half, int x, int y) const { return of(half, x, y) > kMostTimes * around(half, x, y); }
  bool confirmed(std::size_t half, int x, int y) const { return of(half, x, y) <= kMostTimes * of(1 - half, x, y); }

 private:
  std::array<PaddedPlane, 2> halves_;
  PaddedPlane mean_;  ///< of the sum of both, around each pixel
};

/// Of the light by which values of one half stand out from what is around them: the share that the other half has in the same
/// pixels.
float share_confirmed(const Brightness& brightness, int width, int height) {
  double found = 0, confirmed = 0;
  for (std::size_t h = 0; h < 2; ++h) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!brightness.stands_out(h, x, y)) continue;
        const double around = brightness.around(h, x, y);
        found += brightness.of(h, x, y) - around;
        confirmed += brightness.of(1 - h, x, y) - around;
      }
    }
  }
  return found > 0 ? static_cast<float>(std::clamp(confirmed / found, 0.0, 1.0)) : 0;
}

using LostLight = std::array<ColorPlanes, 2>;  ///< by half

/// What stands out in `half` and is not confirmed gives way to the mean around it.
void take_out(Halves& halves, std::size_t half, const Brightness& brightness, float known, LostLight& lost, ColorPlanes& errors,
              ThreadPool& pool) {
  const int width = halves.width(), height = halves.height();
  pool.for_each(static_cast<std::size_t>(height), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      if (!brightness.stands_out(half, x, y) || brightness.confirmed(half, x, y)) continue;
      const float keep = brightness.around(half, x, y) / brightness.of(half, x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = halves.values[half][c].at(x, y);
        const float excess = (1 - keep) * value;
        lost[half][c].at(x, y) = excess;
        errors[c].at(x, y) += known * excess * known * excess;
        value *= keep;
      }
    }
  });
}

}  // namespace

Fireflies take_out_fireflies(Halves& halves, ThreadPool& pool) {
  const int width = halves.width(), height = halves.height();
  const Brightness brightness(halves, pool);
  const float known = share_confirmed(brightness, width, height);
  Fireflies found{color_planes(width, height), {}, {}};
  LostLight lost{color_planes(width, height), color_planes(width, height)};
  for (std::size_t h = 0; h < 2; ++h) take_out(halves, h, brightness, known, lost, found.errors, pool);
  for (std::size_t c = 0; c < 3; ++c) {
    for (ColorPlanes& half : halves.values) half[c].extend();
    for (ColorPlanes& half : lost) half[c].extend();
    const PaddedPlane even = smooth_mean(lost[0][c], kLost, pool), odd = smooth_mean(lost[1][c], kLost, pool);
    found.light[c] = make_plane(width, height, pool, [&](int x, int y) { return std::min(even.at(x, y), odd.at(x, y)); });
    found.differences[c] = make_plane(width, height, pool, [&](int x, int y) {
      const float difference = even.at(x, y) - odd.at(x, y);
      return halves.share[0] * halves.share[1] * difference * difference;
    });
  }
  return found;
}

void Fireflies::give_back(ColorPlanes& filtered, ColorPlanes* mse, ThreadPool& pool) const {
  const int width = errors[0].width(), height = errors[0].height();
  for (std::size_t c = 0; c < 3; ++c) {
    const auto positive = [&](int x, int y) { return std::max(filtered[c].at(x, y), 0.0f); };
    const PaddedPlane around = smooth_mean(make_plane(width, height, pool, positive), kLost, pool);
    pool.for_each(static_cast<std::size_t>(height), 16, [&](std::size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < width; ++x) {
        const float share = around.at(x, y) > 0 ? std::min(positive(x, y) / around.at(x, y), 1.0f) : 0.0f;
        filtered[c].at(x, y) += share * light[c].at(x, y);
        if (mse) (*mse)[c].at(x, y) += errors[c].at(x, y) + share * share * differences[c].at(x, y);
      }
    });
  }
}

}  // namespace tyndall
