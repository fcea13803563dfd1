/// Weighted least squares: what features explain is found, what they do not is averaged.
#include "denoise/regression.h"

#include <doctest/doctest.h>

#include "fake_render.h"

namespace tyndall {
namespace {

constexpr Neighbourhood kWindow{9};

PaddedPlane plane_of(const test::OfPixel& value) {
  PaddedPlane plane(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) plane.at(x, y) = value(x, y);
  plane.extend();
  return plane;
}

/// A fit of one plane, all channels alike, in the window around a pixel.
struct Fit {
  WindowColumns target{kWindow, 3}, fitted{kWindow, 3};
  std::vector<float> weights = std::vector<float>(static_cast<std::size_t>(kWindow.padded()));
  float leverage = 0;

  /// Each pixel counts for `weight`, of its number in the window.
  template <typename Weight>
  Fit(const PaddedPlane& plane, const std::vector<const PaddedPlane*>& features, int at, const Weight& weight) {
    Explanation explanation(kWindow, features);
    Regression regression(kWindow, explanation.columns().count());
    for (int i = 0; i < kWindow.count(); ++i) weights[static_cast<std::size_t>(i)] = weight(i);
    explanation.move_to(at, at);
    for (std::size_t c = 0; c < 3; ++c) target.load(c, plane, at, at);
    leverage = regression.fit(explanation.columns(), target, weights, fitted);
  }
};

float evenly(int) { return 1; }

TEST_CASE("what is linear in position and features is fitted exactly, whatever the weights") {
  Rng rng(5);
  std::vector<float> random(1600);
  for (float& v : random) v = rng.uniform();
  const PaddedPlane f = plane_of([&](int x, int y) { return random[static_cast<std::size_t>(y * 40 + x)]; });
  const PaddedPlane g = plane_of([&](int x, int y) { return x > 19 ? 5.0f + 0.01f * static_cast<float>(y) : 0.0f; });
  const PaddedPlane y = plane_of([&](int i, int j) {
    return 3 + 0.2f * static_cast<float>(i) - 0.1f * static_cast<float>(j) + 2 * f.at(i, j) - 0.5f * g.at(i, j);
  });
  const std::vector<const PaddedPlane*> features{&f, &g};
  const Fit fit(y, features, 20, [&](int) { return 0.1f + rng.uniform(); });
  for (int i = 0; i < kWindow.count(); ++i)
    REQUIRE(std::abs(fit.fitted[1][i] - fit.target[1][i]) < 0.05f);  // the ridge: 1 % of what features span
  double sum = 0;
  for (const float w : fit.weights) sum += w;
  CHECK(fit.leverage == doctest::Approx(5 / sum));
}

TEST_CASE("a feature that says nothing gets no slope, and one like another is shared without harm") {
  const PaddedPlane constant = plane_of([](int, int) { return 4.0f; });
  const PaddedPlane step = plane_of([](int x, int) { return x > 19 ? 1.0f : 0.0f; });
  const std::vector<const PaddedPlane*> features{&constant, &step, &step};
  const Fit fit(step, features, 18, evenly);
  for (int i = 0; i < kWindow.count(); ++i) REQUIRE(std::abs(fit.fitted[0][i] - fit.target[0][i]) < 0.01f);
}

TEST_CASE("a fit leads nowhere below the least value or above the greatest") {
  // A slope by position alone: 0 but for a peak of 9 in a corner.
  const PaddedPlane peak = plane_of([](int x, int y) { return x > 26 && y > 26 ? 9.0f : 0.0f; });
  const Fit fit(peak, {}, 20, evenly);
  for (int i = 0; i < kWindow.count(); ++i) {
    REQUIRE(fit.fitted[0][i] >= 0);
    REQUIRE(fit.fitted[0][i] <= 9);
  }
}

TEST_CASE("a window of which one pixel counts stays as it is there") {
  const PaddedPlane y = plane_of([](int i, int j) { return static_cast<float>(i * j); });
  const Fit fit(y, {}, 20, [](int i) { return i == kWindow.count() / 2 ? 1.0f : 0.0f; });
  CHECK(fit.leverage == 1);
  CHECK(fit.fitted[2][kWindow.count() / 2] == doctest::Approx(400));
}

}  // namespace
}  // namespace tyndall
