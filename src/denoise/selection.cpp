#include "denoise/selection.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int kSmooth = 5;   ///< radius over which errors are pooled, twice
constexpr int kRegion = 20;  ///< the same for what is known of a region only
/// Of the variance among errors pooled over kSmooth that is left in their mean over kRegion: the areas' ratio.
constexpr float kPooledShare =
    static_cast<float>((2 * kSmooth + 1) * (2 * kSmooth + 1)) / ((2 * kRegion + 1) * (2 * kRegion + 1));
constexpr float kMostTimes = 10;        ///< the noise: an error counts as no more in what is known of a region
constexpr float kMostBias = 100;        ///< squared, in variances
constexpr float kRelativeFloor = 0.1f;  ///< of the picture's mean: darker pixels count as this

/// One bandwidth: the mean of both halves, and planes by pixel that are sums over channels, relative to the picture.
struct Candidate {
  ColorPlanes values;
  PaddedPlane error;     ///< squared, may be negative
  PaddedPlane variance;  ///< what of it the filtered halves do not share: it is no less
  PaddedPlane leverage;
};

PaddedPlane pooled(const PaddedPlane& plane, ThreadPool& pool) { return smooth_mean(plane, kSmooth, pool); }

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

/// Squared error over variance, at least 1. Error that is not variance is a small difference of large numbers: it is known of a
/// region, not of a pixel, and there by pixels that have as much to say each, not by the noisiest. What chance might have made
/// of it does not count.
PaddedPlane times_variance(const Candidate& filtered, const PaddedPlane& noise, ThreadPool& pool) {
  const int width = noise.width(), height = noise.height();
  const auto of_region = [&](const auto& value) { return smooth_mean(make_plane(width, height, pool, value), kRegion, pool); };
  const auto per_noise = [&](const PaddedPlane& plane, int x, int y) {
    const float v = noise.at(x, y);
    return v > 0 ? std::max(std::min(plane.at(x, y) / v, kMostTimes), -kMostTimes) : 0.0f;
  };
  const auto bias = [&](int x, int y) { return per_noise(filtered.error, x, y) - per_noise(filtered.variance, x, y); };
  const PaddedPlane variance = of_region([&](int x, int y) { return per_noise(filtered.variance, x, y); });
  const PaddedPlane mean = of_region(bias);
  const PaddedPlane square = of_region([&](int x, int y) { return bias(x, y) * bias(x, y); });
  return make_plane(width, height, pool, [&](int x, int y) {
    const float m = std::max(mean.at(x, y), 0.0f), v = variance.at(x, y);
    const float chance = kPooledShare * std::max(square.at(x, y) - m * m, 0.0f);
    return m > 0 && v > 0 ? 1 + std::min(m / (1 + chance / m / m) / v, kMostBias) : 1.0f;
  });
}

/// Mean over those pixels around that have any light: outlines lie between pixels that have noise and pixels that are black.
PaddedPlane mean_of_lit(const Halves& halves, std::size_t c, int radius, const PaddedPlane& values, ThreadPool& pool) {
  const auto lit = [&](int x, int y) { return halves.mean(c, x, y) != 0 || halves.raw_variance(c, x, y) > 0 ? 1.0f : 0.0f; };
  const PaddedPlane mean = box_mean(values, radius, pool);
  const PaddedPlane share = box_mean(make_plane(halves.width(), halves.height(), pool, lit), radius, pool);
  return make_plane(halves.width(), halves.height(), pool,
                    [&](int x, int y) { return share.at(x, y) > 0 ? mean.at(x, y) / share.at(x, y) : 0.0f; });
}

/// Pooled relative to the picture, so that bright outlines state nothing for what is dark beside them, and no more than a
/// pixel's own value and the difference of its halves can be wrong.
ColorPlanes variance_of_mean(const Halves& halves, const Selection& how, ThreadPool& pool) {
  ColorPlanes variances;
  for (std::size_t c = 0; c < 3; ++c) {
    const PaddedPlane relative = make_plane(halves.width(), halves.height(), pool,
                                            [&](int x, int y) { return halves.raw_variance(c, x, y) * how.weight.at(x, y); });
    const PaddedPlane pooled = mean_of_lit(halves, c, how.noise_radius, relative, pool);
    variances[c] = make_plane(halves.width(), halves.height(), pool, [&](int x, int y) {
      const float mean = halves.mean(c, x, y);
      return std::min(pooled.at(x, y) / how.weight.at(x, y), halves.raw_variance(c, x, y) + mean * mean);
    });
  }
  return variances;
}

/// Of the noise: light of one colour has none in the others.
float share_of_channel(const Halves& halves, std::size_t c, int x, int y) {
  float sum = 0;
  for (const PaddedPlane& plane : halves.variance) sum += plane.at(x, y);
  return sum > 0 ? halves.variance[c].at(x, y) / sum : 1.0f / 3;
}

/// The mean of all samples with weight m, the filtered value with 1 - m: least squared error where C is their covariance.
LightEstimate combine(const Halves& halves, const Candidate& filtered, const Selection& how, ThreadPool& pool) {
  const PaddedPlane& weight = how.weight;
  LightEstimate result(halves.width(), halves.height());
  const PaddedPlane noise = pooled(make_plane(halves.width(), halves.height(), pool,
                                              [&](int x, int y) {
                                                float sum = 0;
                                                for (const PaddedPlane& plane : halves.variance) sum += plane.at(x, y);
                                                return sum * weight.at(x, y);
                                              }),
                                   pool);
  const bool states = how.states_errors;
  const ColorPlanes variances = states ? variance_of_mean(halves, how, pool) : color_planes(halves.width(), halves.height());
  const PaddedPlane with_bias = states ? times_variance(filtered, noise, pool) : PaddedPlane(halves.width(), halves.height());
  pool.for_each(static_cast<std::size_t>(halves.height()), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < halves.width(); ++x) {
      const float v = noise.at(x, y), error = std::max(filtered.error.at(x, y), filtered.variance.at(x, y));
      const float covariance = filtered.leverage.at(x, y) * v;
      const float spread = error + v - 2 * covariance;
      const float best = spread > 0 ? std::clamp((error - covariance) / spread, 0.0f, 1.0f) : 0.0f;
      const float m = how.unfiltered ? std::max(best, how.unfiltered->at(x, y)) : best;
      const float stated = (1 - m) * (1 - m) * filtered.variance.at(x, y) * with_bias.at(x, y);
      const float of_mean = m * m + 2 * m * (1 - m) * filtered.leverage.at(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = result.values[c].at(x, y);
        value = filtered.values[c].at(x, y);
        value += m * (halves.mean(c, x, y) - value);
        result.relative[c].at(x, y) = stated * share_of_channel(halves, c, x, y);
        result.mse[c].at(x, y) = of_mean * variances[c].at(x, y);
      }
    }
  });
  return result;
}

}  // namespace

PaddedPlane relative_weight(const ColorPlanes& light, ThreadPool& pool) {
  const int width = light[0].width(), height = light[0].height();
  const PaddedPlane brightness = make_plane(width, height, pool, [&](int x, int y) {
    float sum = 0;
    for (const PaddedPlane& plane : light) sum += std::abs(plane.at(x, y));
    return sum * (1.0f / 3);
  });
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
