#include "denoise/judged_error.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int kSmooth = 5;   ///< radius over which errors are pooled, twice
constexpr int kRegion = 20;  ///< the same for what is known of a region only
constexpr float kSide = 2 * kSmooth + 1, kRegionSide = 2 * kRegion + 1;
/// Of the variance of pixels that is left in their mean over kSmooth, twice: the sum of its squared weights, of a row and of a
/// column.
constexpr float kRowShare = (2 * kSide * kSide + 1) / (3 * kSide * kSide * kSide), kPooledShare = kRowShare * kRowShare;
/// Of the variance of that mean that is left in its mean over kRegion: the areas' ratio.
constexpr float kRegionShare = kSide * kSide / (kRegionSide * kRegionSide);
/// Squared bias over variance of local linear regression in two dimensions at its best bandwidth, where the former goes with
/// the fourth power and the latter with the inverse square [Fan and Gijbels 1996]: what is expected until more is known.
constexpr float kBestBias = 0.5f;
/// Standard errors of what counts at a pixel. As errors below the variance do not count, chance adds 0.13 of a standard error
/// with one, which is about the variance where filters gain much, and 0.015 with two.
constexpr float kSure = 2;

constexpr float kRelativeFloor = 0.1f;  ///< of the picture's mean: darker pixels count as this

float squared(float v) { return v * v; }

/// What of `value` rises above chance, of which the variance is given: the non-negative garrote [Breiman 1995].
float above_chance(float value, float chance) { return squared(value) > chance ? value - chance / value : 0.0f; }

double sum_of(const PaddedPlane& plane) {
  double sum = 0;
  for (int y = 0; y < plane.height(); ++y)
    for (int x = 0; x < plane.width(); ++x) sum += static_cast<double>(plane.at(x, y));
  return sum;
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

void JudgedError::mix(const JudgedError& other, const PaddedPlane& share, ThreadPool& pool) {
  mix_planes(error, other.error, share, pool);
  mix_planes(chance, other.chance, share, pool);
  mix_planes(variance, other.variance, share, pool);
}

/// With F = a Fa + b Fb of the halves' shares a, b, and independent A, B: E[(F - t)^2] is the mean of what B says of Fa and A
/// of Fb, less a b (Fa - Fb)^2.
JudgedError judge(const Halves& halves, const Filters& filtered, const PaddedPlane& weight, ThreadPool& pool) {
  const float a = halves.share[0], b = halves.share[1];
  const auto pooled = [&](const auto& value) {
    return smooth_mean(make_plane(halves.width(), halves.height(), pool, value), kSmooth, pool);
  };
  const auto value_of = [&](std::size_t half, std::size_t c, int x, int y) { return (*filtered[half])[c].at(x, y); };
  const auto error = [&](int x, int y) {
    float sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const float v = halves.raw_variance(c, x, y), fa = value_of(0, c, x, y), fb = value_of(1, c, x, y);
      const float of_a = squared(halves.values[1][c].at(x, y) - fa) - v / b;
      const float of_b = squared(halves.values[0][c].at(x, y) - fb) - v / a;
      sum += a * of_a + b * of_b - a * b * squared(fa - fb);
    }
    return sum * weight.at(x, y);
  };
  const auto variance = [&](int x, int y) {
    float sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += a * b * squared(value_of(0, c, x, y) - value_of(1, c, x, y));
    return sum * weight.at(x, y);
  };
  return {pooled(error), pooled([&](int x, int y) { return kPooledShare * squared(error(x, y)); }), pooled(variance)};
}

/// Bias is a small difference of large numbers. It goes with the variance as theory says until a region knows better, and
/// otherwise where a pixel's neighbours do: each as far as it rises above chance.
PaddedPlane expected_error(const JudgedError& judged, ThreadPool& pool) {
  const int width = judged.error.width(), height = judged.error.height();
  const auto of_region = [&](const PaddedPlane& plane) { return smooth_mean(plane, kRegion, pool); };
  const PaddedPlane variance = of_region(judged.variance), error = of_region(judged.error), chance = of_region(judged.chance);
  return make_plane(width, height, pool, [&](int x, int y) {
    const float v = judged.variance.at(x, y), around = variance.at(x, y), theory = (1 + kBestBias) * around;
    const float known = std::max(theory + above_chance(error.at(x, y) - theory, kRegionShare * chance.at(x, y)), around);
    const float expected = around > 0 ? v * (known / around) : 0.0f;
    const float here = above_chance(judged.error.at(x, y) - expected, kSure * kSure * judged.chance.at(x, y));
    return std::max(expected + here, v);
  });
}

PaddedPlane pooled_relative(const ColorPlanes& squares, const PaddedPlane& weight, ThreadPool& pool) {
  const auto sum = [&](int x, int y) {
    return (squares[0].at(x, y) + squares[1].at(x, y) + squares[2].at(x, y)) * weight.at(x, y);
  };
  return smooth_mean(make_plane(weight.width(), weight.height(), pool, sum), kSmooth, pool);
}

}  // namespace tyndall
