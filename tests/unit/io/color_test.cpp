#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/color.h"
#include "math/cie.h"

using namespace tyndall;
using doctest::Approx;

namespace {

void check_rgb(Rgb c, Rgb expected, double tolerance) {
  CAPTURE(c.r);
  CAPTURE(c.g);
  CAPTURE(c.b);
  for (int i = 0; i < 3; ++i) CHECK(std::abs(c[i] - expected[i]) <= tolerance);
}

float value_at(const Spectrum& s, float lambda) {
  for (std::size_t i = 0; i + 1 < s.lambda.size(); ++i)
    if (s.lambda[i] <= lambda && lambda <= s.lambda[i + 1]) {
      const float t = (lambda - s.lambda[i]) / (s.lambda[i + 1] - s.lambda[i]);
      return (1 - t) * s.value[i] + t * s.value[i + 1];
    }
  return 0;
}

/// xy of a light's colour.
Vec2 chromaticity(const Spectrum& s) {
  const Rgb c = illuminant_rgb(s);
  const float x = 0.412391f * c.r + 0.357584f * c.g + 0.180481f * c.b;
  const float y = 0.212639f * c.r + 0.715169f * c.g + 0.072192f * c.b;
  const float z = 0.019331f * c.r + 0.119195f * c.g + 0.950532f * c.b;
  return {x / (x + y + z), y / (x + y + z)};
}

double normal_reflectance(double eta, double k) { return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k); }

}  // namespace

TEST_CASE("every name of pbrt-v4 is known, ascending and as long as its wavelengths") {
  std::vector<std::string> names{"stdillum-A", "stdillum-D50", "stdillum-D65", "illum-acesD60"};
  for (const char* metal : {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"})
    for (const char* part : {"-eta", "-k"}) names.push_back(std::string("metal-") + metal + part);
  for (const char* glass : {"BK7", "BAF10", "FK51A", "LASF9", "F5", "F10", "F11"})
    names.push_back(std::string("glass-") + glass);
  for (int f = 1; f <= 12; ++f) names.push_back("stdillum-F" + std::to_string(f));
  for (const std::string& name : names) {
    CAPTURE(name);
    const auto s = named_spectrum(name);
    REQUIRE(s);
    CHECK(s->lambda.size() == s->value.size());
    CHECK(s->lambda.size() >= 30);
    for (std::size_t i = 1; i < s->lambda.size(); ++i) CHECK(s->lambda[i - 1] < s->lambda[i]);
    CHECK(s->lambda.front() <= 380);
    CHECK(s->lambda.back() >= 767);
  }
  CHECK_FALSE(named_spectrum("metal-Fe-eta"));
  CHECK_FALSE(named_spectrum("stdillum-F13"));
  CHECK_FALSE(named_spectrum(""));
}

TEST_CASE("the illuminants have the chromaticities that the CIE publishes") {
  const struct {
    const char* name;
    Vec2 xy;
  } cases[] = {
      {"stdillum-A", {0.44757f, 0.40745f}},    {"stdillum-D50", {0.34567f, 0.35850f}}, {"stdillum-D65", {0.31272f, 0.32903f}},
      {"illum-acesD60", {0.32168f, 0.33767f}}, {"stdillum-F1", {0.31310f, 0.33727f}},  {"stdillum-F2", {0.37208f, 0.37529f}},
      {"stdillum-F3", {0.40910f, 0.39430f}},   {"stdillum-F4", {0.44018f, 0.40329f}},  {"stdillum-F5", {0.31379f, 0.34531f}},
      {"stdillum-F6", {0.37790f, 0.38835f}},   {"stdillum-F7", {0.31292f, 0.32933f}},  {"stdillum-F8", {0.34588f, 0.35875f}},
      {"stdillum-F9", {0.37417f, 0.37281f}},   {"stdillum-F11", {0.38052f, 0.37713f}}, {"stdillum-F12", {0.43695f, 0.40441f}}};
  for (const auto& c : cases) {
    CAPTURE(c.name);
    const Vec2 xy = chromaticity(*named_spectrum(c.name));
    CHECK(std::abs(xy.x - c.xy.x) < 1e-4);
    CHECK(std::abs(xy.y - c.xy.y) < 1e-4);
  }
}

TEST_CASE("D65 and D60 tables, glass and metal indices match published samples") {
  const Spectrum d65 = *named_spectrum("stdillum-D65"), d60 = *named_spectrum("illum-acesD60");
  CHECK(value_at(d65, 400) == Approx(82.7549).epsilon(1e-5));
  CHECK(value_at(d65, 435) == Approx(95.7736).epsilon(1e-5));
  CHECK(value_at(d65, 600) == Approx(90.0062).epsilon(1e-5));
  CHECK(value_at(d65, 830) == Approx(60.3125).epsilon(1e-5));
  CHECK(value_at(d60, 400) == Approx(72.1085).epsilon(1e-5));
  CHECK(value_at(d60, 600) == Approx(91.948).epsilon(1e-5));
  CHECK(value_at(*named_spectrum("glass-BK7"), 300) == Approx(1.55277).epsilon(1e-5));
  CHECK(value_at(*named_spectrum("glass-BK7"), 587.6f) == Approx(1.51680).epsilon(1e-5));  // n_d
  CHECK(value_at(*named_spectrum("glass-BAF10"), 350) == Approx(1.712688).epsilon(1e-5));
  CHECK(value_at(*named_spectrum("glass-FK51A"), 290) == Approx(1.514578).epsilon(1e-5));
  CHECK(value_at(*named_spectrum("glass-LASF9"), 370) == Approx(1.919973).epsilon(1e-5));
  CHECK(value_at(*named_spectrum("glass-F5"), 561.52f) == Approx(1.675636).epsilon(1e-5));
  CHECK(value_at(*named_spectrum("glass-SF10"), 740.4f) == Approx(1.714620).epsilon(1e-5));
  CHECK(value_at(*named_spectrum("glass-F11"), 370) == Approx(1.870022).epsilon(1e-5));
  CHECK(value_at(*named_spectrum("metal-Cu-eta"), 576.6706f) == Approx(0.645875).epsilon(1e-4));
  CHECK(value_at(*named_spectrum("metal-Cu-k"), 576.6706f) == Approx(2.678062).epsilon(1e-4));
}

TEST_CASE("a constant reflectance is exactly grey, however it is given") {
  CHECK(reflectance_rgb({{200, 900}, {3, 3}}) == Rgb(3.0f));
  CHECK(reflectance_rgb({{500}, {0.37f}}) == Rgb(0.37f));
  CHECK(reflectance_rgb({{400, 700}, {0.1f, 0.1f}}) == Rgb(0.1f));
  CHECK(reflectance_rgb({}) == Rgb());
  // The integral itself is grey too: a kink that is not there.
  check_rgb(reflectance_rgb({{200, 550, 900}, {2, 2.00001f, 2}}), Rgb(2.0f), 2e-5);
}

TEST_CASE("reflectances are ordered by hue and never negative") {
  const Rgb red = reflectance_rgb({{360, 590, 600, 830}, {0, 0, 1, 1}});
  CHECK(red.r > 0.9f);
  CHECK(red.g < 0.15f);
  CHECK(red.b == 0.0f);  // out of gamut, clamped
  const Rgb blue = reflectance_rgb({{360, 480, 490, 830}, {1, 1, 0, 0}});
  CHECK(blue.b > blue.r);
  CHECK(blue.b > blue.g);
}

TEST_CASE("lights have luminance 1 and the white of Rec.709 is D65") {
  const Rgb d65 = illuminant_rgb(*named_spectrum("stdillum-D65"));
  check_rgb(d65, Rgb(1.0f), 1e-5);
  for (float scale : {1e-6f, 1.0f, 1e6f}) {
    Spectrum s = *named_spectrum("stdillum-F11");
    for (float& v : s.value) v *= scale;
    CHECK(luminance(illuminant_rgb(s)) == Approx(1).epsilon(2e-4));
  }
  CHECK(illuminant_rgb({{400, 700}, {0, 0}}) == Rgb());
  CHECK(illuminant_rgb({{1000, 2000}, {1, 1}}) == Rgb());
}

TEST_CASE("radiance is the integral of ybar, not normalised") {
  // Y of a constant radiance 1 is the integral of ybar, 106.857 nm.
  CHECK(luminance(radiance_rgb({{300, 900}, {1, 1}})) == Approx(106.857).epsilon(2e-4));
  const Rgb a = radiance_rgb(blackbody_spectrum(3200)), b = blackbody_rgb(3200);
  check_rgb(a, b, 1e-3);
  // Equal-energy white is pinkish beside D65.
  const Rgb e = illuminant_rgb({{300, 900}, {1, 1}});
  check_rgb(e, {1.2048f, 0.9483f, 0.9087f}, 2e-3);
}

TEST_CASE("a black body's spectrum peaks at 1 where Wien says") {
  const Spectrum s = blackbody_spectrum(5000);
  const auto peak = std::max_element(s.value.begin(), s.value.end());
  CHECK(*peak == Approx(1).epsilon(1e-5));
  CHECK(s.lambda[static_cast<std::size_t>(peak - s.value.begin())] == Approx(2.8977721e6 / 5000).epsilon(2e-3));
  for (float v : blackbody_spectrum(0).value) CHECK(v == 0.0f);
  for (float v : blackbody_spectrum(-5).value) CHECK(v == 0.0f);
}

TEST_CASE("metals: each channel's normal reflectance is the colour of the spectral one") {
  const struct {
    const char* name;
    Rgb reflectance;
  } cases[] = {{"Cu", {0.955f, 0.638f, 0.538f}},
               {"Au", {1.0f, 0.782f, 0.344f}},
               {"Ag", {0.972f, 0.960f, 0.915f}},
               {"Al", {0.913f, 0.922f, 0.924f}}};
  for (const auto& c : cases) {
    CAPTURE(c.name);
    const std::string metal = std::string("metal-") + c.name;
    const ConductorRgb rgb = conductor_rgb(*named_spectrum(metal + "-eta"), *named_spectrum(metal + "-k"));
    for (int i = 0; i < 3; ++i) CHECK(std::abs(normal_reflectance(rgb.eta[i], rgb.k[i]) - c.reflectance[i]) < 1e-3);
  }
}

TEST_CASE("metals: constant indices are kept, transparent ones stay possible") {
  const auto constant = [](float v) { return Spectrum{{300, 900}, {v, v}}; };
  const ConductorRgb metal = conductor_rgb(constant(0.2f), constant(3.9f));
  check_rgb(metal.eta, Rgb(0.2f), 1e-6);
  check_rgb(metal.k, Rgb(3.9f), 1e-4);
  const ConductorRgb glass = conductor_rgb(constant(1.5f), constant(0));
  for (int i = 0; i < 3; ++i) CHECK(normal_reflectance(glass.eta[i], glass.k[i]) == Approx(0.04).epsilon(1e-4));
}

TEST_CASE("colour spaces") {
  CHECK(find_color_space("adobe") == nullptr);
  for (const char* name : {"srgb", "rec2020", "aces2065-1", "dci-p3"}) {
    CAPTURE(name);
    const ColorSpace* space = find_color_space(name);
    REQUIRE(space);
    check_rgb(transformed(space->from_rec709, transformed(space->to_rec709, {0.2f, 0.5f, 0.9f})), {0.2f, 0.5f, 0.9f}, 1e-5);
    check_rgb(transformed(space->reflectance_to_rec709, Rgb(1.0f)), Rgb(1.0f), 1e-5);
  }
  // ITU-R BT.2087: Rec.2020 to Rec.709
  const ColorSpace* rec2020 = find_color_space("rec2020");
  check_rgb(transformed(rec2020->to_rec709, {1, 0, 0}), {1.6605f, -0.1246f, -0.0182f}, 2e-4);
  check_rgb(transformed(rec2020->to_rec709, Rgb(1.0f)), Rgb(1.0f), 1e-5);
  // Light of rgb (1,1,1) in ACES is D60.
  check_rgb(transformed(find_color_space("aces2065-1")->to_rec709, Rgb(1.0f)), illuminant_rgb(*named_spectrum("illum-acesD60")),
            1e-5);
  CHECK(find_color_space("srgb")->to_rec709 == std::array<float, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
}
