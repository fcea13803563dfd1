#include "denoise/nl_means.h"

#include <algorithm>

#include "math/simd_math.h"

namespace tyndall {
namespace {

constexpr float kNone = 16;  ///< distance from which on a weight is 0

/// Squared difference less what noise explains, over the noise: d of [Rousselle et al. 2012, eq. 3] for k = 1. Values that have
/// no noise are alike when they agree to 3e-4.
Float8 distance(Float8 p, Float8 q, Float8 variance_p, Float8 variance_q) {
  const Float8 difference = p - q, variance = variance_p + variance_q;
  const Float8 numerator = difference * difference - (variance_p + min(variance_p, variance_q));
  return numerator / (variance + (1e-7f * (p * p + q * q) + 1e-30f));
}

}  // namespace

void PatchDistances::compute(const Guide& guide, const CentreGrid& centres) {
  const int width = (centres.across - 1) * centres.step + 1 + 2 * patch_;
  const int height = (centres.down - 1) * centres.step + 1 + 2 * patch_;
  row_ = (width + 7) / 8 * 8;
  pixels_.resize(static_cast<std::size_t>(row_ * height));
  columns_.resize(static_cast<std::size_t>(row_));
  distances_.assign(static_cast<std::size_t>(centres.count() * neighbourhood_.padded()), kFar);
  const int radius = neighbourhood_.radius;
  int offset = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      pixel_distances(guide, dx, dy, centres);
      sum_patches(offset++, centres);
    }
  }
  mark_outside(guide, centres);
}

void PatchDistances::pixel_distances(const Guide& guide, int dx, int dy, const CentreGrid& centres) {
  const int height = static_cast<int>(pixels_.size()) / row_;
  const Float8 share = 1.0f / static_cast<float>(guide.values.size()), scale = guide.scale;
  for (int j = 0; j < height; ++j) {
    const int y = centres.y0 - patch_ + j, x = centres.x0 - patch_;
    float* to = pixels_.data() + j * row_;
    for (int i = 0; i < row_; i += 8) {
      Float8 sum = 0.0f;
      for (std::size_t c = 0; c < guide.values.size(); ++c) {
        const float* p = guide.values[c]->row(y) + x + i;
        const float* q = guide.values[c]->row(y + dy) + x + dx + i;
        const float* variance_p = guide.variances[c]->row(y) + x + i;
        const float* variance_q = guide.variances[c]->row(y + dy) + x + dx + i;
        sum += min(distance(load8(p), load8(q), scale * load8(variance_p), scale * load8(variance_q)), Float8(kFar));
      }
      store8(to + i, sum * share);
    }
  }
}

void PatchDistances::sum_patches(int offset, const CentreGrid& centres) {
  const int side = 2 * patch_ + 1;
  const float scale = 1.0f / static_cast<float>(side * side);
  for (int j = 0; j < centres.down; ++j) {
    const float* first = pixels_.data() + j * centres.step * row_;
    for (int i = 0; i < row_; i += 8) {
      Float8 sum = load8(first + i);
      for (int k = 1; k < side; ++k) sum += load8(first + k * row_ + i);
      store8(columns_.data() + i, sum);
    }
    for (int i = 0; i < centres.across; ++i) {
      float sum = 0;
      for (int k = 0; k < side; ++k) sum += columns_[static_cast<std::size_t>(i * centres.step + k)];
      distances_[static_cast<std::size_t>((j * centres.across + i) * neighbourhood_.padded() + offset)] = sum * scale;
    }
  }
}

void PatchDistances::mark_outside(const Guide& guide, const CentreGrid& centres) {
  const int radius = neighbourhood_.radius, width = guide.values[0]->width(), height = guide.values[0]->height();
  for (int centre = 0; centre < centres.count(); ++centre) {
    const int x = centres.x(centre), y = centres.y(centre);
    if (x >= radius && y >= radius && x + radius < width && y + radius < height) continue;
    float* d = distances_.data() + centre * neighbourhood_.padded();
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx, ++d) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) *d = kFar;
      }
    }
  }
}

void PatchDistances::weights(int centre, float k, std::span<float> weights) const {
  const float* d = distances_.data() + centre * neighbourhood_.padded();
  const Float8 scale = 1 / (k * k);
  for (int i = 0; i < neighbourhood_.padded(); i += 8) {
    const Float8 x = min(max(load8(d + i) * scale, Float8(0.0f)), Float8(kNone));
    store8(weights.data() + i, choose(x < kNone, fast_exp_minus(x), Float8(0.0f)));
  }
}

}  // namespace tyndall
