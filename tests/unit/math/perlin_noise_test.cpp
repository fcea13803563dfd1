#include "math/perlin_noise.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace tyndall;

TEST_CASE("noise has Perlin's values") {
  // Improved noise is 0 on the lattice; elsewhere the reference implementation's values.
  CHECK(perlin_noise({3, -7, 250}) == 0);
  CHECK(perlin_noise({3.14f, 42, 7}) == doctest::Approx(0.13691995878400012).epsilon(1e-4));

  // Around a lattice point noise is its gradient: pbrt's choice of 12 edge directions, 4 of them twice as likely.
  std::map<std::array<int, 3>, int> counts;
  constexpr int kSide = 40;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Vec3 at{static_cast<float>(i % kSide), static_cast<float>(i / kSide % kSide),
                  static_cast<float>(i / (kSide * kSide))};
    const auto slope = [&](Vec3 d) { return static_cast<int>(std::lround(perlin_noise(at + d * 0.01f) / 0.01f)); };
    ++counts[{slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})}];
  }
  CHECK(counts.size() == 12);
  const std::array<int, 3> twice[] = {{1, 1, 0}, {-1, 1, 0}, {0, 1, -1}, {0, -1, -1}};
  for (const auto& [gradient, count] : counts) {
    const double share = std::find(std::begin(twice), std::end(twice), gradient) == std::end(twice) ? 1 / 16.0 : 2 / 16.0;
    CHECK(count == doctest::Approx(share * kSide * kSide * kSide).epsilon(0.1));
  }
  for (const float huge : {1e9f, 3e38f, -1e20f}) CHECK(std::isfinite(perlin_noise({huge, huge, -huge})));
}
