#include "volume/tracking_kernel.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tyndall;

TEST_CASE("Russian roulette keeps the mean of a transmittance in every channel") {
  constexpr int kCount = 200'000;
  for (const float left : {1e-6f, 1e-3f, 0.004f, 0.0099f, 0.02f, 0.7f}) {
    CAPTURE(left);
    const Rgb before{left, 0.5f * left, -0.25f * left};  // weights of residual tracking may be negative
    Rng rng(3);
    double sum[3] = {};
    int survived = 0;
    for (int i = 0; i < kCount; ++i) {
      Rgb T = before;
      const bool alive = kernel::roulette(T, rng);
      CHECK(alive == !is_black(T));
      survived += alive;
      for (int c = 0; c < 3; ++c) sum[c] += T[c];
    }
    const double chance = std::min(left / kernel::kRouletteBelow, 1.0f);
    const double spread = std::sqrt((1 - chance) / (chance * kCount));  // relative, of the mean
    CHECK(survived / (chance * kCount) == doctest::Approx(1).epsilon(4 * spread + 1e-6));
    for (int c = 0; c < 3; ++c) CHECK(sum[c] / (double{before[c]} * kCount) == doctest::Approx(1).epsilon(4 * spread + 1e-5));
  }
}
