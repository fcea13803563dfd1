/// Film positions in a polygon by the filter: whether their density is what it says, and follows the filter.
#include "transport/pixel/filter_cells.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/rng.h"
#include "support/chi_squared.h"

namespace tyndall {
namespace {

PixelFilter filter_of(PixelFilter::Kind kind, Vec2 radius) {
  PixelFilter filter;
  filter.kind = kind;
  filter.radius = radius;
  return filter;
}

/// Within the support, beyond it, a sliver, and all around it.
std::vector<ConvexPolygon> polygons(Vec2 radius) {
  const double x = radius.x, y = radius.y;
  const auto hull = [](std::vector<Point2> points) { return ConvexPolygon::hull(points); };
  return {hull({{-0.2 * x, 0.1 * y}, {0.5 * x, 0.2 * y}, {0.1 * x, 0.8 * y}}),
          hull({{-1.7 * x, -0.4 * y}, {0.6 * x, -1.5 * y}, {0.3 * x, 0.9 * y}, {-0.9 * x, 2 * y}}),
          hull({{-2 * x, -0.31 * y}, {2 * x, 0.33 * y}, {2 * x, 0.34 * y}}),
          hull({{-3 * x, -3 * y}, {3 * x, -3 * y}, {3 * x, 3 * y}, {-3 * x, 3 * y}})};
}

const std::vector<PixelFilter> kFilters{
    filter_of(PixelFilter::Kind::box, {0.5f, 0.5f}), filter_of(PixelFilter::Kind::gaussian, {1.5f, 1.5f}),
    filter_of(PixelFilter::Kind::triangle, {2, 1}), filter_of(PixelFilter::Kind::mitchell, {2, 2}),
    filter_of(PixelFilter::Kind::sinc, {4, 3})};

/// Quarters of a pixel, which the cells of every filter here are made of.
constexpr double kBin = 0.25;

TEST_CASE("film positions in polygons follow their density, which integrates to 1") {
  constexpr int kDraws = 100'000;
  for (const PixelFilter& filter : kFilters) {
    const FilterCells cells{FilterSampler(filter)};
    const auto [min, max] = cells.support();
    const auto across = static_cast<std::size_t>((max.x - min.x) / kBin),
               down = static_cast<std::size_t>((max.y - min.y) / kBin);
    for (const ConvexPolygon& polygon : polygons(filter.radius)) {
      std::vector<double> counts(across * down), densities(across * down), pmf(across * down);
      Rng rng(7);
      for (int i = 0; i < kDraws; ++i) {
        const float u = rng.uniform(), v = rng.uniform();
        const auto place = cells.sample(polygon, {u, v});
        REQUIRE(place.pdf > 0);
        const auto bin = [&](double at, std::size_t count) {
          REQUIRE((at >= -1e-12 && at <= static_cast<double>(count) + 1e-12));
          return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count) - 1));
        };
        const std::size_t b = bin((place.at.y - min.y) / kBin, down) * across + bin((place.at.x - min.x) / kBin, across);
        if (counts[b]++ > 0) REQUIRE(densities[b] == doctest::Approx(place.pdf).epsilon(1e-9));  // even within a cell
        densities[b] = place.pdf;
      }
      double sum = 0;
      for (std::size_t b = 0; b < pmf.size(); ++b) {
        const Point2 at{min.x + kBin * static_cast<double>(b % across), min.y + kBin * static_cast<double>(b / across)};
        pmf[b] = densities[b] * polygon.cut({at, {at.x + kBin, at.y + kBin}}).area();
        sum += pmf[b];
      }
      CHECK(sum == doctest::Approx(1).epsilon(1e-3));  // but for what was never drawn
      CHECK(test::count_p_value(counts, pmf, kDraws) > test::sidak(1e-3, 20));
    }
  }
}

TEST_CASE("a polygon's mass is what the filter has in it, and its places are drawn by the filter") {
  for (const PixelFilter& filter : kFilters) {
    const FilterSampler sampler(filter);
    const FilterCells cells(sampler);
    CHECK(cells.mass(polygons(filter.radius)[3]) == doctest::Approx(1).epsilon(0.02));
    CHECK(cells.mass(polygons(filter.radius)[0].moved({9, 9})) == 0);
    for (const ConvexPolygon& polygon : polygons(filter.radius)) {
      const double mass = cells.mass(polygon);
      Rng rng(8);
      double sum = 0, squares = 0;
      constexpr int kDraws = 20'000;
      for (int i = 0; i < kDraws; ++i) {
        const float u = rng.uniform(), v = rng.uniform();
        const auto place = cells.sample(polygon, {u, v});
        const double density = sampler.pdf(0, static_cast<float>(place.at.x)) * sampler.pdf(1, static_cast<float>(place.at.y));
        const double weight = density / place.pdf;
        sum += weight, squares += weight * weight;
      }
      const double mean = sum / kDraws, relative_variance = squares / kDraws / (mean * mean) - 1;
      CHECK(mean == doctest::Approx(mass).epsilon(0.05));
      // Filters with negative lobes pass zero within cells. Uniform positions have up to 2.7.
      CHECK(relative_variance <
            (filter.kind == PixelFilter::Kind::sinc || filter.kind == PixelFilter::Kind::mitchell ? 0.4 : 0.1));
    }
  }
}

}  // namespace
}  // namespace tyndall
