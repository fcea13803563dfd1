#include "io/camera_sensor.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "io/color.h"
#include "io/sensor_data.h"

using namespace tyndall;

namespace {

Xyz seen(std::string_view sensor, float kelvin, Xyz rec709) {
  return rec709_from_xyz() * (*sensor_xyz_from_rec709(sensor, kelvin, kD65) * rec709);
}

}  // namespace

TEST_CASE("cameras balanced for the light that there is see its white, and colours much as they are") {
  for (const std::string& name : sensor_names()) {
    CAPTURE(name);
    const Xyz white = seen(name, 6504, {1, 1, 1});
    for (const double v : {white.x, white.y, white.z}) CHECK(v == doctest::Approx(1).epsilon(0.03));
    const Xyz red = seen(name, 6504, {0.6, 0.2, 0.2}), blue = seen(name, 6504, {0.2, 0.2, 0.6});
    CHECK(red.x == doctest::Approx(0.6).epsilon(0.12));
    CHECK(blue.z == doctest::Approx(0.6).epsilon(0.12));
  }
}

TEST_CASE("a camera balanced for warmer light sees daylight as bluer, for bluer light as warmer") {
  for (const std::string& name : sensor_names()) {
    CAPTURE(name);
    const Xyz blue = seen(name, 4000, {1, 1, 1}), warm = seen(name, 12000, {1, 1, 1});
    CHECK(blue.z / blue.x > 1.5);
    CHECK(warm.z / warm.x < 0.8);
  }
}

TEST_CASE("the light a camera is balanced for is white") {
  // A black body of 3000 K and daylight: nothing but the Bradford transform is between the observer's pictures.
  for (const float kelvin : {3000.0f, 5000.0f, 9000.0f}) {
    const Rgb light = illuminant_rgb(daylight_spectrum(kelvin));
    const Xyz c = seen("cie1931", kelvin, {light.r, light.g, light.b});
    for (const double v : {c.x, c.y, c.z}) CHECK(v == doctest::Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("the observer sees what there is; other cameras have a white balance of 6500 K, unknown ones nothing") {
  const Xyz same = seen("cie1931", 0, {0.2, 0.5, 0.9});
  CHECK(same.x == doctest::Approx(0.2));
  CHECK(same.z == doctest::Approx(0.9));
  CHECK(*sensor_xyz_from_rec709("nikon_d810", 0, kD65) == *sensor_xyz_from_rec709("nikon_d810", 6500, kD65));
  CHECK_FALSE(sensor_xyz_from_rec709("nikon", 0, kD65));
}

TEST_CASE("daylight of 6504 K is D65, and below 4000 K it is a black body") {
  const Spectrum d65 = *named_spectrum("stdillum-D65"), same = daylight_spectrum(6500);
  for (std::size_t i = 0; i < d65.value.size(); ++i)
    CHECK(same.value[i] == doctest::Approx(d65.value[i]).epsilon(0.01).scale(1));
  CHECK(daylight_spectrum(3000).lambda.size() == kLambdaCount);
}

TEST_CASE("curves of sensors are smooth and green's peak is 1") {
  for (const SensorTable& table : sensor_tables()) {
    CAPTURE(table.name);
    CHECK(*std::max_element(table.green.begin(), table.green.end()) == 10000);
    for (const auto* curve : {&table.red, &table.green, &table.blue}) {
      CHECK(*std::max_element(curve->begin(), curve->end()) < 10001);
      for (int i = 1; i + 1 < kSensorCount; ++i) {
        const int bend = (*curve)[i - 1] - 2 * (*curve)[i] + (*curve)[i + 1];  // a digit too many or too few would show
        CHECK(std::abs(bend) < 3500);
      }
    }
  }
}
