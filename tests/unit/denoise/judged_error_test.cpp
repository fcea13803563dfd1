/// What the halves tell of a filter's error, against filters whose error is known.
#include "denoise/judged_error.h"

#include <doctest/doctest.h>

#include <cmath>

#include "denoise/collaborative.h"
#include "denoise/features.h"
#include "fake_render.h"

namespace tyndall {
namespace {

constexpr int kWidth = 400, kHeight = 300;

/// Truth 1, independent noise of deviation 1 in either half.
Halves noisy_halves(ThreadPool& pool) {
  Rng rng(4);
  Halves halves{{color_planes(kWidth, kHeight), color_planes(kWidth, kHeight)}, {0.5f, 0.5f}, color_planes(kWidth, kHeight)};
  for (ColorPlanes& half : halves.values) {
    for (PaddedPlane& plane : half) plane = make_plane(kWidth, kHeight, pool, [&](int, int) { return 1 + test::normal(rng); });
  }
  return halves;
}

ColorPlanes constant(float value, ThreadPool& pool) {
  ColorPlanes planes;
  for (PaddedPlane& plane : planes) plane = make_plane(kWidth, kHeight, pool, [&](int, int) { return value; });
  return planes;
}

PaddedPlane plane_of(float value, ThreadPool& pool) { return constant(value, pool)[0]; }

struct Moments {
  double mean = 0, variance = 0;
};

/// Of pixels far enough apart to be independent of each other.
Moments of_distant_pixels(const PaddedPlane& plane) {
  double sum = 0, squares = 0, count = 0;
  for (int y = 11; y < kHeight; y += 22) {
    for (int x = 11; x < kWidth; x += 22) {
      const double value = plane.at(x, y);
      sum += value, squares += value * value, ++count;
    }
  }
  return {sum / count, squares / count - sum * sum / count / count};
}

}  // namespace

// 252 independent pixels: their mean is known to 0.013, their variance to 9 %.
TEST_CASE("a half judges what the other is filtered to without bias, and chance is as large as said") {
  ThreadPool pool(1);
  const Halves halves = noisy_halves(pool);
  const PaddedPlane weight = plane_of(2, pool);
  // Of bias 0.2 each, and of errors that the halves do not share: 0.2 +- 0.3.
  const ColorPlanes even = constant(1.5f, pool), odd = constant(0.9f, pool);
  const JudgedError judged = judge(halves, {&even, &odd}, weight, pool);
  const Moments error = of_distant_pixels(judged.error);
  CHECK(error.mean == doctest::Approx(2 * 3 * 0.04).epsilon(0.2));
  CHECK(of_distant_pixels(judged.chance).mean == doctest::Approx(error.variance).epsilon(0.3));
  CHECK(judged.variance.at(50, 50) == doctest::Approx(2 * 3 * 0.09));
}

TEST_CASE("what a half is filtered to, and its features, know nothing of the other's") {
  ThreadPool pool(1);
  Rng rng(5);
  const auto noise = [&] { return make_plane(60, 50, pool, [&](int, int) { return 1 + test::normal(rng); }); };
  Halves halves{{ColorPlanes{noise(), noise(), noise()}, ColorPlanes{noise(), noise(), noise()}},
                {0.5f, 0.5f},
                {plane_of(1, pool), plane_of(1, pool), plane_of(1, pool)}};
  Feature feature{{{{noise()}, {noise()}}}};
  const auto filter = [&] {
    const Feature clean = prefiltered(feature, pool);
    return regress(halves, {{{&clean.halves[0][0]}, {&clean.halves[1][0]}}}, pool);
  };
  const FilteredHalves before = filter();
  halves.values[1] = {noise(), noise(), noise()};
  // As far from the first half as before, so that their noise seems the same.
  PaddedPlane& other = feature.halves[1][0];
  other = make_plane(60, 50, pool, [&](int x, int y) { return 2 * feature.halves[0][0].at(x, y) - other.at(x, y); });
  const FilteredHalves after = filter();
  for (std::size_t k = 0; k < kBandwidths.size(); ++k) {
    CHECK(before[0][k].values[1].at(30, 25) == doctest::Approx(after[0][k].values[1].at(30, 25)).epsilon(1e-5));
    CHECK(std::abs(before[1][k].values[1].at(30, 25) - after[1][k].values[1].at(30, 25)) > 1e-3f);
  }
}

TEST_CASE("what is expected of an error: theory until more is known, never less than the variance") {
  ThreadPool pool(1);
  const auto expected = [&](float error, float chance) {
    return expected_error({plane_of(error, pool), plane_of(chance, pool), plane_of(2, pool)}, pool).at(200, 150);
  };
  CHECK(expected(9, 1e9f) == doctest::Approx(3));
  CHECK(expected(9, 0) == doctest::Approx(9));
  CHECK(expected(-5, 0) == doctest::Approx(2));
  // A region knows to sqrt(0.072 chance) what a pixel knows to sqrt(chance), and each counts as it rises above that.
  CHECK(expected(5, 4) == doctest::Approx(3 + 2 - 4 * 121.0 / 1681 / 2));
  // 40x40 pixels know of 13 to a deviation of 2, and their region knows nothing: 3 + 10 - 4 * 4 / 10.
  JudgedError here{plane_of(3, pool), plane_of(1500, pool), plane_of(2, pool)};
  for (int y = 130; y < 170; ++y)
    for (int x = 180; x < 220; ++x) here.error.at(x, y) = 13, here.chance.at(x, y) = 4;
  const PaddedPlane result = expected_error(here, pool);
  CHECK(result.at(200, 150) > 11.3f);
  CHECK(result.at(200, 150) < 11.5f);
  CHECK(result.at(240, 150) < 3.1f);
}

}  // namespace tyndall
