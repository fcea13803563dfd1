/// Places that lights stand close to: each pixel finds its own, and positions follow the light there.
#include "transport/pixel/peaks.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "math/rng.h"
#include "support/chi_squared.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// A plane that is seen at an angle, lengths unlike pixels.
Peak peak_at(Vec2 at, float height, LightId light = 7) {
  return {.light = light, .at = at, .right = {30, 4}, .down = {-2, 11}, .height = height, .brightness = 1};
}

/// The largest offset along each axis of the film of many positions.
Vec2 farthest(const Peak& peak, Rng& rng) {
  Vec2 most{};
  for (int i = 0; i < 100'000; ++i) {
    const float u = rng.uniform(), v = rng.uniform();
    const Vec2 x = peak.draw({u, v});
    most = {std::max(most.x, std::abs(x.x - peak.at.x)), std::max(most.y, std::abs(x.y - peak.at.y))};
  }
  return most;
}

}  // namespace

// A density off by 4 % in one of 256 bins of about 1,600 draws is seen.
TEST_CASE("positions near the foot of a light follow their density, those of two planes under it theirs together") {
  constexpr int kDraws = 400'000, kSide = 16;
  const Vec2 corner{98, 48};
  constexpr float kSize = 5;
  PixelPeaks::List peaks;
  peaks.push_back(peak_at({100.6f, 50.1f}, 3));
  peaks.push_back(peak_at({100.1f, 50.9f}, 5));
  peaks.push_back(peak_at({101.2f, 49.4f}, 2, 9));
  peaks[1].brightness = 2;
  const PixelPeaks pixel(peaks);
  Rng rng(5);
  std::vector<double> counts(2 * kSide * kSide + 1, 0.0), pmf;
  for (int k = 0; k < kDraws; ++k) {
    const float which = rng.uniform();
    const float u = rng.uniform(), v = rng.uniform();
    const auto drawn = pixel.draw(which, {u, v});
    CHECK(drawn.pdf == pixel.pdf(drawn.light, drawn.x));
    const Vec2 in = (drawn.x - corner) * (kSide / kSize);
    const bool inside = in.x >= 0 && in.y >= 0 && in.x < kSide && in.y < kSide;
    const std::size_t bin = static_cast<std::size_t>(in.y) * kSide + static_cast<std::size_t>(in.x);
    counts[inside ? (drawn.light == 7 ? 0 : kSide * kSide) + bin : 2 * kSide * kSide] += 1;
  }
  double sum = 0;
  for (const LightId light : {7u, 9u}) {
    for (int bin = 0; bin < kSide * kSide; ++bin) {
      constexpr int kSteps = 32;
      constexpr float kStep = kSize / (kSide * kSteps);
      double p = 0;
      for (int s = 0; s < kSteps * kSteps; ++s) {
        const Vec2 in{static_cast<float>(bin % kSide * kSteps + s % kSteps) + 0.5f,
                      static_cast<float>(bin / kSide * kSteps + s / kSteps) + 0.5f};
        p += double{pixel.pdf(light, corner + in * kStep)} * kStep * kStep;
      }
      sum += pmf.emplace_back(p);
    }
  }
  CHECK(sum == doctest::Approx(1).epsilon(5e-3));
  pmf.push_back(std::max(0.0, 1 - sum));
  CHECK(count_p_value(counts, pmf, kDraws) > 1e-3);
  CHECK(pixel.pdf(8, {100.6f, 50.1f}) == 0);
}

TEST_CASE("near the foot density goes as the light that arrives there") {
  const Peak peak = peak_at({10, 10}, 6);
  const auto irradiance = [&](Vec2 x) {
    const Vec2 v = peak.right * (x.x - peak.at.x) + peak.down * (x.y - peak.at.y);
    return peak.height / std::pow(peak.height * peak.height + v.x * v.x + v.y * v.y, 1.5f);
  };
  const float ratio = peak.pdf(peak.at) / irradiance(peak.at);
  for (const Vec2 x : {Vec2{10.1f, 10}, Vec2{9.7f, 11.2f}, Vec2{10.4f, 9}})
    CHECK(peak.pdf(x) == doctest::Approx(ratio * irradiance(x)).epsilon(1e-4));
}

TEST_CASE("positions reach as far as is said, and no farther") {
  Rng rng(3);
  for (const float height : {0.1f, 5.0f}) {
    const Peak peak = peak_at({0, 0}, height);
    const Vec2 most = farthest(peak, rng), reach = peak.reach();
    CHECK(most.x <= reach.x * 1.0001f);
    CHECK(most.y <= reach.y * 1.0001f);
    CHECK(most.x > 0.98f * reach.x);
    CHECK(most.y > 0.98f * reach.y);
  }
}

TEST_CASE("a pixel has the peaks that reach under its filter, in crops too, and of many the brightest") {
  Rng rng(8);
  std::vector<Peak> peaks;
  for (LightId i = 0; i < 40; ++i) {
    const float x = 1.4f * rng.uniform() - 0.2f, y = 1.4f * rng.uniform() - 0.2f;
    peaks.push_back(peak_at({24 * x, 18 * y}, 2 + 10 * rng.uniform(), i));
  }
  for (const Vec2 radius : {Vec2{0.5f, 0.5f}, Vec2{1.5f, 2}}) {
    for (const PixelBounds pixels : {PixelBounds{0, 0, 24, 18}, PixelBounds{5, 3, 9, 18}}) {
      const FilmPeaks film(pixels, radius, peaks);
      for (int y = pixels.y0; y < pixels.y1; ++y) {
        for (int x = pixels.x0; x < pixels.x1; ++x) {
          const PixelPeaks pixel = film.of(x, y);
          std::size_t expected = 0, found = 0;
          for (const Peak& peak : peaks) {
            const Vec2 most = peak.reach() + radius;
            const float dx = peak.at.x - (static_cast<float>(x) + 0.5f), dy = peak.at.y - (static_cast<float>(y) + 0.5f);
            const bool reaches = std::abs(dx) < most.x && std::abs(dy) < most.y;
            const bool has = pixel.pdf(peak.light, peak.at) > 0;
            expected += reaches;
            found += has;
            if (has) CHECK(reaches);
          }
          CHECK(found == std::min(expected, PixelPeaks::kMost));
        }
      }
    }
  }
  std::vector<Peak> many;
  for (LightId i = 0; i < 100; ++i) {
    many.push_back(peak_at({2.5f, 2.5f}, 3, i));
    many.back().brightness = static_cast<float>(1 + i);
  }
  const PixelPeaks brightest = FilmPeaks({0, 0, 4, 4}, {0.5f, 0.5f}, many).of(2, 2);
  for (LightId i = 0; i < 100; ++i) CHECK((brightest.pdf(i, {2.5f, 2.5f}) > 0) == (i >= 100 - PixelPeaks::kMost));
}

TEST_CASE("peaks that are dark, not finite, off the film or along all of it are nowhere") {
  const float nan = std::nanf("");
  std::vector<Peak> peaks{peak_at({nan, 1}, 1), peak_at({1e30f, 1}, 1), peak_at({-9, 1}, 1), peak_at({1, 1}, 1e6f)};
  for (const float brightness : {0.0f, nan, kInfinity}) {
    peaks.push_back(peak_at({1, 1}, 1));
    peaks.back().brightness = brightness;
  }
  const FilmPeaks none({0, 0, 4, 4}, {0.5f, 0.5f}, peaks);
  for (int i = 0; i < 16; ++i) CHECK(none.of(i % 4, i / 4).empty());
}
