#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "math/blackbody.h"
#include "math/cie.h"
#include "tyndall/color.h"

using namespace tyndall;
using doctest::Approx;

namespace {

Vec2 chromaticity(Rgb c) {
  const Xyz v = inverse(rec709_from_xyz()) * Xyz{c.r, c.g, c.b};
  return {static_cast<float>(v.x / (v.x + v.y + v.z)), static_cast<float>(v.y / (v.x + v.y + v.z))};
}

}  // namespace

TEST_CASE("the observer's integrals are those of the CIE's 1 nm table") {
  Xyz sum;
  for (const Xyz& v : color_matching_functions()) sum = sum + v;
  CHECK(sum.x == Approx(106.865469).epsilon(1e-5));
  CHECK(sum.y == Approx(kYIntegral).epsilon(1e-5));
  CHECK(sum.z == Approx(106.892256).epsilon(1e-5));
  const Xyz at_555 = color_matching_functions()[555 - kLambdaMin];
  CHECK(at_555.y == 1.0);
}

TEST_CASE("black bodies lie on the Planckian locus") {
  // xy of the locus, Wyszecki and Stiles
  const struct {
    float kelvin;
    Vec2 xy;
  } cases[] = {{1500, {0.5857f, 0.3931f}},
               {2856, {0.4475f, 0.4074f}},
               {4000, {0.3805f, 0.3768f}},
               {6504, {0.3135f, 0.3237f}},
               {10000, {0.2807f, 0.2884f}}};
  for (const auto& c : cases) {
    CAPTURE(c.kelvin);
    const Vec2 xy = chromaticity(blackbody_rgb(c.kelvin));
    CHECK(std::abs(xy.x - c.xy.x) < 3e-4);
    CHECK(std::abs(xy.y - c.xy.y) < 3e-4);
  }
}

TEST_CASE("black bodies are normalised by their peak, not by T^4") {
  CHECK(normalized_blackbody(2.8977721e6 / 4000, 4000) == Approx(1).epsilon(1e-6));
  for (double t : {300.0, 1000.0, 6500.0, 40000.0})
    for (double lambda : {360.0, 555.0, 830.0}) {
      CHECK(normalized_blackbody(lambda, t) <= 1);
      CHECK(normalized_blackbody(lambda, t) >= 0);
    }
  const Rgb c = blackbody_rgb(6500);
  CHECK(luminance(c) == Approx(94.4).epsilon(5e-3));
}

TEST_CASE("black bodies are finite everywhere and smooth") {
  CHECK(blackbody_rgb(0) == Rgb());
  CHECK(blackbody_rgb(-1) == Rgb());
  CHECK(blackbody_rgb(std::numeric_limits<float>::quiet_NaN()) == Rgb());
  CHECK(blackbody_rgb(kInfinity) == Rgb());
  for (float t : {1e-38f, 1e-10f, 1.0f, 30.0f, 1e6f, 1e20f, 3e38f}) CHECK(is_finite(blackbody_rgb(t)));
  CHECK(normalized_blackbody(500, 1e-200) == 0);
  Rgb before = blackbody_rgb(499);
  float slope_before = 0;
  for (float t = 500; t < 12000; t += 1) {
    const Rgb c = blackbody_rgb(t);
    const float slope = c.r - before.r;
    if (t > 500) REQUIRE(std::abs(slope - slope_before) < 1e-3f);
    slope_before = slope;
    before = c;
  }
}

TEST_CASE("chromaticities of files become matrices") {
  const auto identity = rec709_from({}, false);
  CHECK(identity == std::array<float, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  const Chromaticities rec2020{{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}};
  const auto m = rec709_from(rec2020, false);
  CHECK(m[0] == Approx(1.6605).epsilon(2e-4));
  CHECK(m[0] + m[1] + m[2] == Approx(1).epsilon(1e-5));
  const Chromaticities aces{{0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.0770f}, {0.32168f, 0.33767f}};
  const auto light = rec709_from(aces, false), reflectance = rec709_from(aces, true);
  CHECK(light[0] + light[1] + light[2] > 1.03f);
  for (int row = 0; row < 3; ++row)
    CHECK(reflectance[3 * row] + reflectance[3 * row + 1] + reflectance[3 * row + 2] == Approx(1).epsilon(1e-5));
}
