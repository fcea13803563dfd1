/// Point lights on the film: each pixel finds its own, and positions around them follow their density.
#include "transport/pixel/point_images.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "math/rng.h"
#include "support/chi_squared.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr float kFinest = 640 * 0x1p-20f;

std::vector<FilmPoint> random_points(int count, int width, int height, Rng& rng) {
  std::vector<FilmPoint> points;
  for (int i = 0; i < count; ++i) {
    const auto beyond = [&](int size) { return (1.2f * rng.uniform() - 0.1f) * static_cast<float>(size); };
    const Vec2 at{beyond(width), beyond(height)};
    points.push_back({static_cast<LightId>(i), at, 0.1f + rng.uniform()});
  }
  return points;
}

/// Those a pixel sees, by looking at all.
std::vector<LightId> seen_by(int x, int y, Vec2 radius, const std::vector<FilmPoint>& points) {
  std::vector<LightId> seen;
  for (const FilmPoint& point : points) {
    const float dx = point.at.x - (static_cast<float>(x) + 0.5f), dy = point.at.y - (static_cast<float>(y) + 0.5f);
    if (std::abs(dx) < radius.x && std::abs(dy) < radius.y) seen.push_back(point.light);
  }
  return seen;
}

}  // namespace

TEST_CASE("a pixel has the point lights that its filter sees, in crops and at the film's edges too") {
  Rng rng(3);
  const auto points = random_points(300, 24, 18, rng);
  for (const Vec2 radius : {Vec2{0.5f, 0.5f}, Vec2{1.5f, 1.5f}, Vec2{2, 0.75f}}) {
    for (const PixelBounds pixels : {PixelBounds{0, 0, 24, 18}, PixelBounds{5, 3, 9, 18}}) {
      const FilmPoints all({pixels, radius, kFinest}, points);
      for (int y = pixels.y0; y < pixels.y1; ++y) {
        for (int x = pixels.x0; x < pixels.x1; ++x) {
          const PixelPoints of_pixel = all.of(x, y);
          const auto expected = seen_by(x, y, radius, points);
          CHECK(of_pixel.empty() == expected.empty());
          std::size_t found = 0;
          for (const FilmPoint& point : points) {
            const bool drawn = of_pixel.pdf(point.light, {point.at.x + 0.1f, point.at.y}) > 0;
            found += drawn;
            if (drawn) CHECK(std::count(expected.begin(), expected.end(), point.light) == 1);
          }
          CHECK(found == std::min(expected.size(), PixelPoints::kMost));
        }
      }
    }
  }
}

TEST_CASE("of many point lights in a pixel the brightest are drawn") {
  std::vector<FilmPoint> points;
  for (LightId i = 0; i < 100; ++i) points.push_back({i, {2.5f, 2.5f}, static_cast<float>(1 + i)});
  const PixelPoints brightest = FilmPoints({{0, 0, 4, 4}, {1.5f, 1.5f}, kFinest}, points).of(2, 2);
  for (LightId i = 0; i < 100; ++i) CHECK((brightest.pdf(i, {2.6f, 2.5f}) > 0) == (i >= 100 - PixelPoints::kMost));
}

TEST_CASE("filters of any width are taken, those of many pixels without point lights") {
  const std::vector<FilmPoint> points{{0, {1, 1}, 1}};
  for (const float radius : {0x1p-40f, 1.0f, 20.0f, 100.0f, 1e5f, 3e9f, 0x1p120f}) {
    const PixelPoints pixel = FilmPoints({{0, 0, 4, 4}, {radius, radius}, kFinest}, points).of(1, 1);
    CHECK(pixel.empty() == (radius < 0.5f || radius > 50));
    if (!pixel.empty()) CHECK(pixel.pdf(0, pixel.draw(0.5f, {0.5f, 0.5f}).x) > 0);
  }
}

TEST_CASE("point lights that are dark, not finite or off the film are nowhere") {
  const float nan = std::nanf("");
  const std::vector<FilmPoint> points{{0, {1, 1}, 0},   {1, {1, 1}, nan},   {2, {1, 1}, kInfinity},
                                      {3, {nan, 1}, 1}, {4, {1e30f, 1}, 1}, {5, {-3, 1}, 1}};
  const FilmPoints none({{0, 0, 4, 4}, {1.5f, 1.5f}, kFinest}, points);
  for (int i = 0; i < 16; ++i) CHECK(none.of(i % 4, i / 4).empty());
}

// Each light's positions, in rings and sectors. A density off by 3 % in one of 48 bins of 2,000 draws or more is seen.
TEST_CASE("point lights and positions around them follow their density") {
  constexpr int kDraws = 400'000, kRings = 8, kSectors = 3;
  const std::vector<FilmPoint> points{{7, {100.6f, 50.1f}, 1}, {9, {101.1f, 51.2f}, 3}};
  const PixelPoints pixel = FilmPoints({{0, 0, 640, 360}, {1.5f, 1.5f}, kFinest}, points).of(100, 50);
  Rng rng(11);
  std::vector<double> counts(points.size() * kRings * kSectors + 1, 0.0), pmf;
  constexpr double kRing = (0.3 * 1.5 - kFinest) / kRings;
  for (int k = 0; k < kDraws; ++k) {
    const float which = rng.uniform();
    const Vec2 around{rng.uniform(), rng.uniform()};
    const auto drawn = pixel.draw(which, around);
    if (!(drawn.pdf > 0)) continue;
    CHECK(drawn.pdf == pixel.pdf(drawn.light, drawn.x));
    const std::size_t index = drawn.light == 7 ? 0 : 1;
    const Vec2 at = points[index].at;
    const double distance = std::hypot(drawn.x.x - at.x, drawn.x.y - at.y);
    const double angle = std::atan2(drawn.x.y - at.y, drawn.x.x - at.x);
    const int ring = std::min(static_cast<int>((distance - kFinest) / kRing), kRings - 1);
    const int sector = std::min(static_cast<int>((angle / (2 * kPi) + 0.5) * kSectors), kSectors - 1);
    counts[(index * kRings + ring) * kSectors + sector] += 1;
  }
  double sum = 0;
  for (const FilmPoint& point : points) {
    for (int i = 0; i < kRings * kSectors; ++i) {
      const int ring = i / kSectors;
      double p = 0;  // by the midpoint rule in the distance: density times distance is constant
      constexpr int kSteps = 64;
      for (int s = 0; s < kSteps; ++s) {
        const double distance = kFinest + (ring + (s + 0.5) / kSteps) * kRing;
        p += pixel.pdf(point.light, {point.at.x + static_cast<float>(distance), point.at.y}) * distance * kRing / kSteps;
      }
      sum += pmf.emplace_back(p * 2 * kPi / kSectors);
    }
  }
  CHECK(sum == doctest::Approx(1).epsilon(2e-3));
  pmf.push_back(std::max(0.0, 1 - sum));
  CHECK(count_p_value(counts, pmf, kDraws) > 1e-3);
  CHECK(pixel.pdf(8, points[0].at) == 0);
  CHECK(pixel.pdf(7, points[0].at) == 0);  // nearer than can be drawn
}
