#include "denoise/selection.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

constexpr int kChoice = 5;  ///< radius over which choices are mixed

/// One bandwidth.
struct Candidate {
  std::array<ColorPlanes, 2> values;  ///< by half
  PaddedPlane leverage;
  JudgedError judged;
};

Candidate candidate(const Halves& halves, Filtered even, Filtered odd, const PaddedPlane& weight, ThreadPool& pool) {
  const auto leverage = [&](int x, int y) {
    return halves.share[0] * even.leverage.at(x, y) + halves.share[1] * odd.leverage.at(x, y);
  };
  JudgedError judged = judge(halves, {&even.values, &odd.values}, weight, pool);
  return {{std::move(even.values), std::move(odd.values)},
          make_plane(halves.width(), halves.height(), pool, leverage),
          std::move(judged)};
}

Candidate better_of(Candidate first, const Candidate& second, ThreadPool& pool) {
  const PaddedPlane choice = make_plane(first.leverage.width(), first.leverage.height(), pool, [&](int x, int y) {
    return second.judged.error.at(x, y) < first.judged.error.at(x, y) ? 1.0f : 0.0f;
  });
  const PaddedPlane share = box_mean(choice, kChoice, pool);
  for (std::size_t h = 0; h < 2; ++h) {
    for (std::size_t c = 0; c < 3; ++c) mix_planes(first.values[h][c], second.values[h][c], share, pool);
  }
  mix_planes(first.leverage, second.leverage, share, pool);
  first.judged.mix(second.judged, share, pool);
  return first;
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

/// The mean of all samples with weight m, the filtered value with 1 - m: least squared error where C is their covariance.
LightEstimate combine(const Halves& halves, const Candidate& filtered, const Selection& how, ThreadPool& pool) {
  LightEstimate result(halves.width(), halves.height());
  const PaddedPlane noise = pooled_relative(halves.variance, how.weight, pool);
  const PaddedPlane expected = expected_error(filtered.judged, pool);
  const ColorPlanes variances = variance_of_mean(halves, how, pool);
  pool.for_each(static_cast<std::size_t>(halves.height()), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < halves.width(); ++x) {
      const float v = noise.at(x, y), error = expected.at(x, y), covariance = filtered.leverage.at(x, y) * v;
      const float spread = error + v - 2 * covariance;
      const float best = spread > 0 ? std::clamp((error - covariance) / spread, 0.0f, 1.0f) : 0.0f;
      const float m = how.unfiltered ? std::max(best, how.unfiltered->at(x, y)) : best;
      const float of_mean = m * m + 2 * m * (1 - m) * filtered.leverage.at(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t h = 0; h < 2; ++h) {
          const float value = (1 - m) * filtered.values[h][c].at(x, y) + m * halves.values[h][c].at(x, y);
          result.halves[h][c].at(x, y) = value;
          result.values[c].at(x, y) += halves.share[h] * value;
        }
        result.apart[c].at(x, y) = (1 - m) * (filtered.values[0][c].at(x, y) - filtered.values[1][c].at(x, y));
        result.mse[c].at(x, y) = of_mean * variances[c].at(x, y);
      }
    }
  });
  return result;
}

}  // namespace

LightEstimate Selection::operator()(const Halves& halves, FilteredHalves filtered, ThreadPool& pool) const {
  Candidate best = candidate(halves, std::move(filtered[0][0]), std::move(filtered[1][0]), weight, pool);
  for (std::size_t k = 1; k < kBandwidths.size(); ++k)
    best =
        better_of(std::move(best), candidate(halves, std::move(filtered[0][k]), std::move(filtered[1][k]), weight, pool), pool);
  return combine(halves, best, *this, pool);
}

}  // namespace tyndall
