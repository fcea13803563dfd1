#include "math/perlin_noise.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "math/rng.h"

using namespace tyndall;

TEST_CASE("noise has Perlin's values") {
  // Improved noise is 0 on the lattice; elsewhere the reference implementation's values.
  CHECK(perlin_noise({3, -7, 250}) == 0);
  CHECK(perlin_noise({3.14f, 42, 7}) == doctest::Approx(0.13691995878400012).epsilon(1e-4));

  // By formulas one after the other, with a gradient chosen by cases; the last is beyond where floats have fractions, and
  // wraps.
  struct At {
    Vec3 p;
    float noise;
  };
  for (const auto& [p, noise] : {At{{0.5f, 0.25f, 0.75f}, -0.375078678f}, At{{-0.5f, 0.25f, 0.75f}, -0.0994973183f},
                                 At{{12.3f, -45.6f, 78.9f}, -0.271503866f}, At{{255.9f, 255.9f, 255.9f}, -0.188260183f},
                                 At{{256.1f, -0.1f, 512.4f}, 0.485373497f}, At{{-1000.7f, 3000.2f, -77.7f}, -0.0349382199f},
                                 At{{100000.5f, -100000.5f, 0.5f}, 0.125f}, At{{3e7f, 0.3f, 0.6f}, 0.181444764f}})
    CHECK(perlin_noise(p) == noise);

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

TEST_CASE("a cell of noise gives it at all points that it holds") {
  Rng rng(3);
  int held = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto around = [&](float center, float size) { return center + size * (2 * rng.uniform() - 1); };
    const Vec3 p{around(0, 300), around(0, 300), around(0, 300)};
    const Vec3 q{around(p.x, 0.3f), around(p.y, 0.3f), around(p.z, 0.3f)};
    const bool same =
        std::floor(p.x) == std::floor(q.x) && std::floor(p.y) == std::floor(q.y) && std::floor(p.z) == std::floor(q.z);
    const NoiseCell cell(p);
    REQUIRE(cell.holds(q) == same);
    if (same) REQUIRE(cell.at(q) == perlin_noise(q));
    held += same ? 1 : 0;
  }
  CHECK(held > 10'000);
}
