#include "denoise/selection.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int kSmooth = 5;              ///< radius over which errors are pooled, twice
constexpr float kRelativeFloor = 0.1f;  ///< of the picture's mean: darker pixels count as this

/// One bandwidth: the mean of both halves, and planes by pixel that are sums over channels, relative to the picture.
struct Candidate {
  ColorPlanes values;
  PaddedPlane error;     ///< squared, may be negative
  PaddedPlane variance;  ///< what of it the filtered halves do not share: it is no less
  PaddedPlane leverage;
};

PaddedPlane pooled(const PaddedPlane& plane, ThreadPool& pool) {
  return box_mean(box_mean(plane, kSmooth, pool), kSmooth, pool);
}

double sum_of(const PaddedPlane& plane) {
  double sum = 0;
  for (int y = 0; y < plane.height(); ++y)
    for (int x = 0; x < plane.width(); ++x) sum += static_cast<double>(plane.at(x, y));
  return sum;
}

/// With F = a Fa + b Fb of the halves' shares a, b, and independent A, B: the other half judges each [Rousselle et al. 2012].
Candidate candidate(const Halves& halves, const Filtered& fa, const Filtered& fb, const PaddedPlane& weight, ThreadPool& pool) {
  const int width = halves.width(), height = halves.height();
  const float a = halves.share[0], b = halves.share[1];
  Candidate result;
  for (std::size_t c = 0; c < 3; ++c)
    result.values[c] =
        make_plane(width, height, pool, [&](int x, int y) { return a * fa.values[c].at(x, y) + b * fb.values[c].at(x, y); });
  const auto squared = [](float v) { return v * v; };
  result.error = make_plane(width, height, pool, [&](int x, int y) {
    float sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const float v = halves.raw_variance(c, x, y), va = fa.values[c].at(x, y), vb = fb.values[c].at(x, y);
      const float of_a = squared(halves.values[1][c].at(x, y) - va) - v / b;
      const float of_b = squared(halves.values[0][c].at(x, y) - vb) - v / a;
      sum += a * of_a + b * of_b - a * b * squared(va - vb);
    }
    return sum * weight.at(x, y);
  });
  result.variance = make_plane(width, height, pool, [&](int x, int y) {
    float sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += a * b * squared(fa.values[c].at(x, y) - fb.values[c].at(x, y));
    return sum * weight.at(x, y);
  });
  result.error = pooled(result.error, pool);
  result.variance = pooled(result.variance, pool);
  result.leverage =
      make_plane(width, height, pool, [&](int x, int y) { return a * fa.leverage.at(x, y) + b * fb.leverage.at(x, y); });
  return result;
}

void mix(PaddedPlane& first, const PaddedPlane& second, const PaddedPlane& share, ThreadPool& pool) {
  first = make_plane(first.width(), first.height(), pool,
                     [&](int x, int y) { return first.at(x, y) + share.at(x, y) * (second.at(x, y) - first.at(x, y)); });
}

Candidate better_of(Candidate first, const Candidate& second, ThreadPool& pool) {
  const PaddedPlane choice = make_plane(first.error.width(), first.error.height(), pool, [&](int x, int y) {
    return second.error.at(x, y) < first.error.at(x, y) ? 1.0f : 0.0f;
  });
  const PaddedPlane share = box_mean(choice, kSmooth, pool);
  for (std::size_t c = 0; c < 3; ++c) mix(first.values[c], second.values[c], share, pool);
  mix(first.error, second.error, share, pool);
  mix(first.variance, second.variance, share, pool);
  mix(first.leverage, second.leverage, share, pool);
  return first;
}

/// Pooled, but no more than its own value and the difference of its halves can be wrong: what is black beside an outline is.
float variance_of_mean(const Halves& halves, std::size_t c, int x, int y) {
  const float mean = halves.mean(c, x, y);
  return std::min(halves.variance[c].at(x, y), halves.raw_variance(c, x, y) + mean * mean);
}

/// The mean of all samples with weight m, the filtered value with 1 - m: least squared error where C is their covariance.
LightEstimate combine(const Halves& halves, const Candidate& filtered, const Selection& how, ThreadPool& pool) {
  const PaddedPlane& weight = how.weight;
  LightEstimate result{color_planes(halves.width(), halves.height()), color_planes(halves.width(), halves.height())};
  const PaddedPlane noise = pooled(make_plane(halves.width(), halves.height(), pool,
                                              [&](int x, int y) {
                                                float sum = 0;
                                                for (const PaddedPlane& plane : halves.variance) sum += plane.at(x, y);
                                                return sum * weight.at(x, y);
                                              }),
                                   pool);
  // Error that is not variance is a small difference of large numbers: it is known of the picture, not of a place in it.
  const double variance = sum_of(filtered.variance);
  const float with_bias = variance > 0 ? static_cast<float>(std::max(sum_of(filtered.error) / variance, 1.0)) : 1.0f;
  pool.for_each(static_cast<std::size_t>(halves.height()), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < halves.width(); ++x) {
      const float v = noise.at(x, y), error = std::max(filtered.error.at(x, y), filtered.variance.at(x, y));
      const float covariance = filtered.leverage.at(x, y) * v;
      const float spread = error + v - 2 * covariance;
      const float best = spread > 0 ? std::clamp((error - covariance) / spread, 0.0f, 1.0f) : 0.0f;
      const float m = how.unfiltered ? std::max(best, how.unfiltered->at(x, y)) : best;
      const float stated = (1 - m) * (1 - m) * filtered.variance.at(x, y) * with_bias;
      const float of_mean = m * m + 2 * m * (1 - m) * filtered.leverage.at(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = result.values[c].at(x, y);
        value = filtered.values[c].at(x, y);
        value += m * (halves.mean(c, x, y) - value);
        result.mse[c].at(x, y) = stated / weight.at(x, y) * (1.0f / 3) + of_mean * variance_of_mean(halves, c, x, y);
      }
    }
  });
  return result;
}

}  // namespace

PaddedPlane relative_weight(const ColorPlanes& light, ThreadPool& pool) {
  const int width = light[0].width(), height = light[0].height();
  const PaddedPlane brightness = box_mean(make_plane(width, height, pool,
                                                     [&](int x, int y) {
                                                       float sum = 0;
                                                       for (const PaddedPlane& plane : light) sum += std::abs(plane.at(x, y));
                                                       return sum * (1.0f / 3);
                                                     }),
                                          1, pool);
  const float floor = kRelativeFloor * static_cast<float>(sum_of(brightness) / (static_cast<double>(width) * height));
  return make_plane(width, height, pool, [&](int x, int y) {
    const float value = brightness.at(x, y);
    return 1 / (value * value + floor * floor + 1e-30f);
  });
}

LightEstimate Selection::operator()(const Halves& halves, const FilteredHalves& filtered, ThreadPool& pool) const {
  Candidate best = candidate(halves, filtered[0][0], filtered[1][0], weight, pool);
  for (std::size_t k = 1; k < kBandwidths.size(); ++k)
    best = better_of(std::move(best), candidate(halves, filtered[0][k], filtered[1][k], weight, pool), pool);
  return combine(halves, best, *this, pool);
}

}  // namespace tyndall
