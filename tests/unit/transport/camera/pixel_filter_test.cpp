#include "transport/camera/pixel_filter.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/chi_squared.h"
#include "transport/sample/sampler.h"

using namespace tyndall;

namespace {

PixelFilter make(PixelFilter::Kind kind, float radius) {
  PixelFilter filter;
  filter.kind = kind;
  filter.radius = {radius, radius * 0.75f};
  return filter;
}

/// Integral of filter * cos(x + 2y) over its support divided by the integral of the filter, by the midpoint rule.
double filtered(const PixelFilter& filter, int n = 400) {
  double sum = 0, norm = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const float x = filter.radius.x * (2 * (i + 0.5f) / n - 1), y = filter.radius.y * (2 * (j + 0.5f) / n - 1);
      const double f = filter_value(filter, {x, y});
      sum += f * std::cos(x + 2 * y);
      norm += f;
    }
  }
  return sum / norm;
}

}  // namespace

TEST_CASE("weighted samples give the filtered value, negative lobes included") {
  using Kind = PixelFilter::Kind;
  for (const auto& filter : {make(Kind::box, 0.5f), make(Kind::triangle, 2), make(Kind::gaussian, 1.5f),
                             make(Kind::mitchell, 2), make(Kind::sinc, 4)}) {
    const FilterSampler sampler(filter);
    double sum = 0, weights = 0;
    bool inside = true;
    const int n = 2048;  // the sign changes of sinc fall between grid points: the error of the sums goes as 1/n
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const auto s = sampler.sample({(i + 0.5f) / n, (j + 0.5f) / n});
        inside = inside && std::abs(s.p.x) <= filter.radius.x && std::abs(s.p.y) <= filter.radius.y;
        sum += s.weight * std::cos(s.p.x + 2 * s.p.y);
        weights += s.weight;
      }
    }
    CHECK(inside);
    CHECK(weights / (n * n) == doctest::Approx(1).epsilon(2e-3));
    CHECK(sum / (n * n) == doctest::Approx(filtered(filter)).epsilon(4e-3));
  }
}

TEST_CASE("filters that are nowhere negative have weight 1") {
  const FilterSampler sampler(make(PixelFilter::Kind::gaussian, 1.5f));
  for (float u : {0.0f, 0.3f, 0.999f}) CHECK(sampler.sample({u, 1 - u - 1e-4f}).weight == doctest::Approx(1));
}

TEST_CASE("what is drawn is known again by its place, and beyond the radius there is nothing") {
  using Kind = PixelFilter::Kind;
  for (const auto& filter : {make(Kind::box, 0.5f), make(Kind::gaussian, 1.5f), make(Kind::mitchell, 2), make(Kind::sinc, 4)}) {
    const FilterSampler sampler(filter);
    double integral = 0, filtered_cosine = 0;
    const int n = 1000;
    for (int i = 0; i < n; ++i) {
      const Vec2 u{(static_cast<float>(i) + 0.5f) / n, std::fmod(0.618034f * static_cast<float>(i), 1.0f)};
      const auto drawn = sampler.sample(u), again = sampler.at(drawn.p);
      CHECK(again.weight == drawn.weight);
      CHECK(again.pdf == doctest::Approx(drawn.pdf).epsilon(0.05));
      for (int k = 0; k < n; ++k) {
        const float x = 2 * (static_cast<float>(i) + 0.5f) / n - 1, y = 2 * (static_cast<float>(k) + 0.5f) / n - 1;
        const Vec2 p{filter.radius.x * x, filter.radius.y * y};
        const auto at = sampler.at(p);
        integral += at.pdf;
        filtered_cosine += at.pdf * at.weight * std::cos(p.x + 2 * p.y);
      }
    }
    const double area = 4.0 * filter.radius.x * filter.radius.y / (n * n);
    CHECK(integral * area == doctest::Approx(1).epsilon(2e-3));
    CHECK(filtered_cosine * area == doctest::Approx(filtered(filter)).epsilon(4e-3));
    CHECK(sampler.at({1.01f * filter.radius.x, 0}).pdf == 0);
    CHECK(sampler.at({0, -1.01f * filter.radius.y}).pdf == 0);
  }
}

TEST_CASE("offsets follow their density") {
  using Kind = PixelFilter::Kind;
  constexpr int kDraws = 200'000, kBins = 24, kLooks = 40;
  for (const auto& filter : {make(Kind::gaussian, 1.5f), make(Kind::mitchell, 2), make(Kind::sinc, 4)}) {
    const FilterSampler sampler(filter);
    std::vector<double> counts(kBins * kBins);
    std::vector<double> pmf(kBins * kBins);
    const auto bin = [](float x, float radius) {
      return std::min(static_cast<int>(kBins * (0.5f + 0.5f * x / radius)), kBins - 1);
    };
    Rng rng(3);
    for (int i = 0; i < kDraws; ++i) {
      const float u = rng.uniform();
      const Vec2 p = sampler.sample({u, rng.uniform()}).p;
      ++counts[bin(p.y, filter.radius.y) * kBins + bin(p.x, filter.radius.x)];
    }
    constexpr int n = kBins * kLooks;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        const Vec2 p{filter.radius.x * (2 * (k + 0.5f) / n - 1), filter.radius.y * (2 * (i + 0.5f) / n - 1)};
        pmf[i / kLooks * kBins + k / kLooks] += sampler.at(p).pdf * 4 * filter.radius.x * filter.radius.y / (n * n);
      }
    }
    CHECK(test::count_p_value(counts, pmf, kDraws) > test::sidak(1e-3, 3));
  }
}

TEST_CASE("weights of sixteen samples of a pixel have no noise, and those of fewer no bias") {
  using Kind = PixelFilter::Kind;
  for (const auto& filter : {make(Kind::mitchell, 2), make(Kind::sinc, 4)}) {
    const FilterSampler sampler(filter);
    const auto mean = [&](int pixel, int samples) {
      double sum = 0;
      for (int i = 0; i < samples; ++i) sum += sampler.sample(Sampler({.x = pixel, .sample = i}).next_2d()).weight;
      return sum / samples;
    };
    constexpr int kPixels = 4000;
    double of_four = 0, squares = 0;
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      REQUIRE(mean(pixel, 16) == doctest::Approx(1).epsilon(1e-5));
      const double four = mean(pixel, 4);
      of_four += four / kPixels, squares += four * four / kPixels;
    }
    const double error = std::sqrt((squares - of_four * of_four) / kPixels);
    CHECK(std::abs(of_four - 1) < 3.5 * error);
    CHECK(error < 0.02);  // which a sum without the negative lobes, 0.2 and 0.5 too large, is far from
  }
}
