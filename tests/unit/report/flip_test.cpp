/// FLIP against the implementation its authors published. The numbers below were printed by their NumPy code
/// (github.com/NVlabs/flip, python/flip_api.py of 2021), run once on the pictures below with OpenCV's filter2D replaced by
/// a plain loop; it filters in two dimensions and goes through sRGB, where ours is separable and stays linear.
#include "report/flip.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tyndall/error.h"
#include "unit/report/pictures.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr int kWidth = 48, kHeight = 40;

enum class Change { none, noise, spot, fade };

/// A coloured checkerboard on a ramp; with noise, with a red spot of 4 x 4 pixels, or faded.
Image checkerboard(Change change, bool high_range = false) {
  return picture(kWidth, kHeight, [=](int x, int y, int k) {
    const double noise = (x * 73 + y * 151 + k * 199 + (x * y) % 17 * 31) % 256 / 255.0;
    double v = (0.1 + 0.8 * x / (kWidth - 1)) * ((x / 6 + y / 5 + k) % 2 ? 1 : 0.35);
    if (change == Change::noise) v *= 0.75 + 0.5 * noise;
    if (change == Change::spot && x >= 20 && x < 24 && y >= 10 && y < 14) v = k == 0 ? 1 : 0;
    if (change == Change::fade) v = v * 0.9 + 0.02;
    return high_range ? 20 * v * v * v * v : v;
  });
}

/// Mean, pixels (5, 7), (22, 12), (47, 39), (0, 0), and maximum.
using Numbers = std::array<double, 6>;

void check(const FlipMap& map, const Numbers& expected) {
  const auto at = [&](int x, int y) { return double(map.values[static_cast<std::size_t>(y * kWidth + x)]); };
  const Numbers found{map.mean(), at(5, 7), at(22, 12),
                      at(47, 39), at(0, 0), double(*std::max_element(map.values.begin(), map.values.end()))};
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(close(found[i], expected[i], 2e-4));
  }
}

/// FLIP of two uniform pictures: no features, so it is the colour difference alone.
double of_colors(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return flip_ldr(flat(20, 20, a[0], a[1], a[2]), flat(20, 20, b[0], b[1], b[2])).values[210];
}

}  // namespace

TEST_CASE("LDR-FLIP gives the published implementation's numbers") {
  const Image reference = checkerboard(Change::none);
  check(flip_ldr(checkerboard(Change::noise), reference), {0.099501, 0.031595, 0.066136, 0.300185, 0.058597, 0.316101});
  check(flip_ldr(checkerboard(Change::spot), reference), {0.016746, 0, 0.588302, 0, 0, 0.591424});
  check(flip_ldr(checkerboard(Change::fade), reference), {0.127402, 0.099821, 0.122145, 0.246321, 0.154754, 0.246321});
  check(flip_ldr(checkerboard(Change::noise), reference, {.pixels_per_degree = 30}),
        {0.188156, 0.076812, 0.156557, 0.415735, 0.137485, 0.489545});
}

TEST_CASE("HDR-FLIP gives the published implementation's numbers and exposures") {
  const Image reference = checkerboard(Change::none, true);
  const FlipMap noise = flip_hdr(checkerboard(Change::noise, true), reference);
  CHECK(close(noise.start_exposure, -2.15563, 1e-5));
  CHECK(close(noise.stop_exposure, 1.91859, 1e-5));
  CHECK(noise.exposures == 5);
  check(noise, {0.225680, 0.172128, 0.190145, 0.288264, 0.034784, 0.627395});
  check(flip_hdr(checkerboard(Change::spot, true), reference), {0.025735, 0, 0.842166, 0, 0, 0.883608});
  check(flip_hdr(checkerboard(Change::fade, true), reference), {0.207978, 0.045408, 0.298245, 0.204077, 0.051236, 0.395916});
}

TEST_CASE("uniform colours: the published implementation's numbers; green and blue are farthest apart") {
  CHECK(close(of_colors({0, 1, 0}, {0, 0, 1}), 1, 1e-5));
  CHECK(close(of_colors({1, 0, 0}, {0, 1, 0}), 0.986663, 1e-4));
  CHECK(close(of_colors({0, 0, 0}, {1, 1, 1}), 0.967383, 1e-4));
  CHECK(close(of_colors({0.5, 0.5, 0.5}, {0.5, 0.5, 0.52}), 0.074567, 1e-3));
}

TEST_CASE("identities: nothing between equal pictures, the same either way, within [0, 1]") {
  const Image a = checkerboard(Change::none), b = checkerboard(Change::noise);
  CHECK(flip_ldr(a, a).mean() == 0);
  CHECK(flip_hdr(a, a).mean() == 0);
  CHECK(flip_ldr(a, b).values == flip_ldr(b, a).values);

  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 3);
  const Image wild = picture(31, 17, [&](int, int, int) { return uniform(engine); });
  const Image wilder = picture(31, 17, [&](int, int, int) { return std::pow(10, 8 * uniform(engine)); });
  for (const FlipMap& map : {flip_ldr(wild, wilder), flip_hdr(wild, wilder), flip_hdr(wilder, wild)}) {
    for (const float v : map.values) CHECK((v >= 0 && v <= 1));
  }
}

TEST_CASE("a factor on both pictures changes LDR-FLIP and leaves HDR-FLIP") {
  const auto scaled = [](Image image, float s) {
    for (Channel& c : image.channels) {
      for (float& v : c.values) v *= s;
    }
    return image;
  };
  const Image a = checkerboard(Change::noise, true), b = checkerboard(Change::none, true);
  CHECK(close(flip_hdr(scaled(a, 64), scaled(b, 64)).mean(), flip_hdr(a, b).mean(), 1e-4));
  CHECK(std::abs(flip_ldr(scaled(a, 64), scaled(b, 64)).mean() - flip_ldr(a, b).mean()) > 0.01);
}

TEST_CASE("black and nearly black references have exposures") {
  const Image black = flat(8, 8, 0, 0, 0);
  CHECK(flip_hdr(black, black).mean() == 0);
  CHECK(flip_hdr(flat(8, 8, 1, 1, 1), black).mean() > 0.5);
  const Image one_pixel = picture(8, 8, [](int x, int y, int) { return x == 3 && y == 4 ? 5.0 : 0.0; });
  const FlipMap map = flip_hdr(black, one_pixel);
  CHECK(map.exposures == 2);
  CHECK(map.mean() > 0);
}

TEST_CASE("what cannot be compared is refused") {
  CHECK_THROWS_AS(flip_ldr(flat(4, 4, 0, 0, 0), flat(4, 5, 0, 0, 0)), Error);
  CHECK_THROWS_AS(flip_ldr(flat(4, 4, 0, 0, 0), picture(4, 4, [](int, int, int) { return 0; }, {"Y"})), Error);
  CHECK_THROWS_AS(flip_hdr(flat(4, 4, 0, 0, 0), flat(4, 4, 0, 0, 0), {.pixels_per_degree = 0}), Error);
}
