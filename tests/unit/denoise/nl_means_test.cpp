/// Patch distances by brute force, and the weights of pixels that are alike.
#include "denoise/nl_means.h"

#include <doctest/doctest.h>

#include "fake_render.h"

namespace tyndall {
namespace {

using test::normal;

PaddedPlane noise(int width, int height, std::uint64_t seed) {
  Rng rng(seed);
  PaddedPlane plane(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) plane.at(x, y) = normal(rng);
  plane.extend();
  return plane;
}

PaddedPlane constant(int width, int height, float value) {
  PaddedPlane plane(width, height);
  for (int y = 0; y < height; ++y) std::fill_n(plane.row(y), width, value);
  plane.extend();
  return plane;
}

/// d as in [Rousselle et al. 2012, eq. 3], pixel by pixel.
double patch_distance(const Guide& guide, Vec2 p, Vec2 q, int radius) {
  double sum = 0;
  for (int j = -radius; j <= radius; ++j) {
    for (int i = -radius; i <= radius; ++i) {
      for (std::size_t c = 0; c < guide.values.size(); ++c) {
        const auto value = [&](const PaddedPlane* plane, Vec2 at) {
          return static_cast<double>(plane->at(static_cast<int>(at.x) + i, static_cast<int>(at.y) + j));
        };
        const double difference = value(guide.values[c], p) - value(guide.values[c], q);
        const double vp = guide.scale * value(guide.variances[c], p), vq = guide.scale * value(guide.variances[c], q);
        sum += std::min((difference * difference - (vp + std::min(vp, vq))) / (vp + vq + 1e-30), 1e4);
      }
    }
  }
  return sum / (static_cast<double>(guide.values.size()) * (2 * radius + 1) * (2 * radius + 1));
}

TEST_CASE("distances of patches are those of their pixels, and pixels outside the picture are far") {
  const PaddedPlane a = noise(30, 20, 1), b = noise(30, 20, 2), one = constant(30, 20, 0.7f), two = constant(30, 20, 1.3f);
  Guide guide{{&a, &b}, {&one, &two}, 1.5f};
  const Neighbourhood around{4};
  const CentreGrid centres{1, 2, 3, 10, 6};
  PatchDistances distances(around, 2);
  distances.compute(guide, centres);
  std::vector<float> weights(static_cast<std::size_t>(around.padded()));
  for (int centre = 0; centre < centres.count(); centre += 7) {
    distances.weights(centre, 0.8f, weights);
    int row = 0;
    for (int dy = -4; dy <= 4; ++dy) {
      for (int dx = -4; dx <= 4; ++dx, ++row) {
        const int x = centres.x(centre), y = centres.y(centre);
        const bool inside = x + dx >= 0 && y + dy >= 0 && x + dx < 30 && y + dy < 20;
        const Vec2 p{static_cast<float>(x), static_cast<float>(y)}, q{static_cast<float>(x + dx), static_cast<float>(y + dy)};
        const double expected = inside ? std::exp(-std::max(patch_distance(guide, p, q, 2), 0.0) / 0.64) : 0;
        REQUIRE(weights[static_cast<std::size_t>(row)] == doctest::Approx(expected).epsilon(1e-3));
      }
    }
    for (; row < around.padded(); ++row) REQUIRE(weights[static_cast<std::size_t>(row)] == 0);
  }
}

// 10,000 pixels of which 80 a centre are looked at; patches overlap, so that about 2,000 are independent: 0.005 of standard
// error. The means are the table's of ALGORITHMS_IMAGE 1.1 for the true variance.
TEST_CASE("pixels that differ by noise alone weigh 0.80 on average for k = 0.5, 0.93 for k = 1") {
  const PaddedPlane values = noise(120, 120, 3), variance = constant(120, 120, 1);
  const Guide guide{{&values}, {&variance}, 1};
  const Neighbourhood around{5};
  const CentreGrid centres{10, 10, 5, 20, 20};
  PatchDistances distances(around, 3);
  distances.compute(guide, centres);
  std::vector<float> weights(static_cast<std::size_t>(around.padded()));
  for (const auto& [k, expected] : {std::pair{0.5f, 0.80}, std::pair{1.0f, 0.93}}) {
    double sum = 0;
    for (int centre = 0; centre < centres.count(); ++centre) {
      distances.weights(centre, k, weights);
      for (int i = 0; i < around.count(); ++i) sum += i == around.count() / 2 ? 0.0f : weights[static_cast<std::size_t>(i)];
    }
    CHECK(sum / (centres.count() * (around.count() - 1)) == doctest::Approx(expected).epsilon(0.02));
  }
}

}  // namespace
}  // namespace tyndall
