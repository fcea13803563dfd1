/// The error that a block's halves tell is the one it has, on average.
#include <doctest/doctest.h>

#include <cstdio>

#include "math/rng.h"
#include "session/film_buffer.h"

using namespace tyndall;

namespace {

constexpr int kSide = 8, kSamples = 32;

/// What a block of pixels says of itself over what is true, the mean of so many.
/// `sample(x, y, rng)` has mean and variance `mean(x, y)`, `variance(x, y)`.
template <typename Sample, typename Mean, typename Variance>
double told_over_true(const Sample& sample, const Mean& mean, const Variance& variance, int blocks) {
  Film film;
  film.width = film.height = kSide;
  const PixelBounds crop{0, 0, kSide, kSide};
  double told = 0, truth = 0;
  for (int b = 0; b < blocks; ++b) {
    FilmBuffer buffer(film, crop, {});
    Rng rng(static_cast<std::uint64_t>(b) + 1);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        for (int s = 0; s < kSamples; ++s) {
          PathRecord record;
          record.surface_direct = Rgb(sample(x, y, rng));
          buffer.add({x, y, s}, record, 1);
        }
        truth += variance(x, y) / kSamples / (mean(x, y) * mean(x, y) + 0.01);
      }
    }
    told += buffer.noise(crop, kSamples).error;
  }
  return told / truth;
}

}  // namespace

// One sample in 40 has 20 times the light of the others: a pixel that was hit seems to have more light than it has, and its
// error to be a smaller part of it. By a pixel's own square alone 0.71 of the error is told. The bounds are four standard
// errors wide.
TEST_CASE("rare bright samples do not hide their own error") {
  constexpr double kChance = 1 / 40.0, kDim = 0.5, kBright = 10;
  const auto sample = [](int, int, Rng& rng) { return rng.uniform() < float(kChance) ? float(kBright) : float(kDim); };
  const auto mean = [](int, int) { return kDim + kChance * (kBright - kDim); };
  const auto variance = [](int, int) { return kChance * (1 - kChance) * (kBright - kDim) * (kBright - kDim); };
  const double ratio = told_over_true(sample, mean, variance, 100);
  std::printf("  rare bright samples: %.3f of the error told\n", ratio);
  CHECK(ratio > 0.85);
  CHECK(ratio < 1.15);
}

// Pixels 300 times as bright as those around them, with as much relative noise: their light is no noise.
TEST_CASE("bright pixels among dark ones keep their own brightness") {
  const auto bright = [](int x, int y) { return x % 4 == 1 && y % 4 == 1; };
  const auto mean = [&](int x, int y) { return bright(x, y) ? 300.0 : 1.0; };
  const auto variance = [&](int x, int y) { return mean(x, y) * mean(x, y) / 3; };
  const auto sample = [&](int x, int y, Rng& rng) { return static_cast<float>(mean(x, y)) * 2 * rng.uniform(); };
  const double ratio = told_over_true(sample, mean, variance, 100);
  std::printf("  bright pixels among dark ones: %.3f of the error told\n", ratio);
  CHECK(ratio > 0.85);
  CHECK(ratio < 1.15);
}
