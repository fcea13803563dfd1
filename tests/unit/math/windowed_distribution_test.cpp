#include "math/windowed_distribution.h"

#include <doctest/doctest.h>

#include "math/rng.h"
#include "support/chi_squared.h"

namespace tyndall {
namespace {

constexpr int kWidth = 5, kHeight = 4;

std::vector<float> weights() {
  Rng rng(3);
  std::vector<float> w;
  for (int i = 0; i < kWidth * kHeight; ++i) w.push_back(i % 7 == 2 ? 0 : rng.uniform() * (i == 8 ? 100 : 1));
  return w;
}

/// Of the density over a rectangle in the window, by the cells that it overlaps.
double mass(const std::vector<float>& w, const Window& a) {
  double sum = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double wide = std::min(a.x1, (x + 1.0) / kWidth) - std::max(a.x0, double(x) / kWidth);
      const double high = std::min(a.y1, (y + 1.0) / kHeight) - std::max(a.y0, double(y) / kHeight);
      if (wide > 0 && high > 0) sum += w[std::size_t(y * kWidth + x)] * wide * high;
    }
  return sum;
}

TEST_CASE("a windowed distribution is sampled by its weights, whatever the window") {
  const std::vector<float> w = weights();
  const WindowedDistribution distribution(kWidth, kHeight, w);
  Rng rng(7);
  for (const Window& window : {Window{0, 0, 1, 1}, Window{0.13, 0.2, 0.71, 0.98}, Window{0.41, 0.51, 0.45, 0.55},
                               Window{0.2, 0.25, 0.6, 0.5}, Window{0.59, 0.01, 0.61, 0.99}}) {
    constexpr int kCells = 6, kSamples = 40'000;
    std::vector<double> counts(kCells * kCells), pmf;
    const double all = mass(w, window);
    for (int i = 0; i < kCells * kCells; ++i) {
      const double dx = (window.x1 - window.x0) / kCells, dy = (window.y1 - window.y0) / kCells;
      const double x = window.x0 + (i % kCells) * dx, y = window.y0 + (i / kCells) * dy;
      pmf.push_back(mass(w, {x, y, x + dx, y + dy}) / all);
    }
    for (int i = 0; i < kSamples; ++i) {
      const float ux = rng.uniform(), uy = rng.uniform();
      const auto s = distribution.sample(window, {ux, uy});
      REQUIRE(s);
      REQUIRE(window.contains(s->x, s->y));
      REQUIRE(s->pdf == distribution.pdf(window, s->x, s->y));
      const auto cell = [](double v, double a, double b) { return std::min(int((v - a) / (b - a) * kCells), kCells - 1); };
      counts[std::size_t(cell(s->y, window.y0, window.y1) * kCells + cell(s->x, window.x0, window.x1))] += 1;
      const double weight =
          w[std::size_t(std::min(int(s->y * kHeight), kHeight - 1) * kWidth + std::min(int(s->x * kWidth), kWidth - 1))];
      REQUIRE(s->pdf == doctest::Approx(weight / all));
    }
    CHECK(test::count_p_value(counts, pmf, kSamples) > 1e-5);
    CHECK(distribution.pdf(window, window.x1 + 0.01, 0.5) == 0);
  }
}

TEST_CASE("a window that holds nothing is sampled evenly, an empty one not at all") {
  std::vector<float> w(16, 0.0f);
  w[0] = 1;
  const WindowedDistribution distribution(4, 4, w);
  const Window dark{0.5, 0.5, 0.75, 1};
  const auto s = distribution.sample(dark, {0.5f, 0.25f});
  REQUIRE(s);
  CHECK(s->x == doctest::Approx(0.625));
  CHECK(s->y == doctest::Approx(0.625));
  CHECK(s->pdf == doctest::Approx(8));
  CHECK(!distribution.sample({0.5, 0.5, 0.5, 1}, {0.5f, 0.5f}));
  CHECK(distribution.pdf({0.5, 0.5, 0.5, 1}, 0.5, 0.7) == 0);
}

}  // namespace
}  // namespace tyndall
