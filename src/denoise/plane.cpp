#include "denoise/plane.h"

#include <algorithm>

namespace tyndall {

void PaddedPlane::extend() {
  for (int y = 0; y < height_; ++y) {
    std::fill_n(row(y) - kMargin, kMargin, at(0, y));
    std::fill_n(row(y) + width_, kMargin, at(width_ - 1, y));
  }
  for (int y = 1; y <= kMargin; ++y) {
    std::copy_n(row(0) - kMargin, stride(), row(-y) - kMargin);
    std::copy_n(row(height_ - 1) - kMargin, stride(), row(height_ - 1 + y) - kMargin);
  }
}

void add_planes(ColorPlanes& sum, const ColorPlanes& part) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < sum[c].height(); ++y) {
      for (int x = 0; x < sum[c].width(); ++x) sum[c].at(x, y) += part[c].at(x, y);
    }
  }
}

PaddedPlane box_mean(const PaddedPlane& plane, int radius, ThreadPool& pool) {
  const int width = plane.width(), height = plane.height();
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  const PaddedPlane across = make_plane(width, height, pool, [&](int x, int y) {
    float sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += plane.row(y)[x + i];
    return sum * scale;
  });
  return make_plane(width, height, pool, [&](int x, int y) {
    float sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += across.row(y + i)[x];
    return sum * scale;
  });
}

void mix_planes(PaddedPlane& first, const PaddedPlane& second, const PaddedPlane& share, ThreadPool& pool) {
  first = make_plane(first.width(), first.height(), pool,
                     [&](int x, int y) { return first.at(x, y) + share.at(x, y) * (second.at(x, y) - first.at(x, y)); });
}

}  // namespace tyndall
