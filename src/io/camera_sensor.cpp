#include "io/camera_sensor.h"

#include <array>
#include <cmath>

#include "io/color.h"
#include "io/sensor_data.h"

namespace tyndall {
namespace {

using Curves = std::array<Sampled, 3>;

Sampled sampled(const std::array<std::uint16_t, kSensorCount>& table) {
  Spectrum spectrum;
  for (int i = 0; i < kSensorCount; ++i) {
    spectrum.lambda.push_back(static_cast<float>(380 + 10 * i));
    spectrum.value.push_back(static_cast<float>(table[i]) * 1e-4f);
  }
  return tyndall::sampled(spectrum);
}

const Curves& observer() {
  static const Curves kCurves = [] {
    Curves curves;
    for (int i = 0; i < kLambdaCount; ++i) {
      const Xyz c = color_matching_functions()[i];
      curves[0][i] = c.x, curves[1][i] = c.y, curves[2][i] = c.z;
    }
    return curves;
  }();
  return kCurves;
}

/// Smooth reflectances all around the colour circle: everything below or above a wavelength, a band and all but a band,
/// from 0.1 to 0.7. They stand for what lies before a camera, as pbrt's colour chart does.
std::vector<Sampled> training_reflectances() {
  constexpr double kEdgeWidth = 15;  // nm
  std::vector<Sampled> result;
  const auto add = [&](double from, double to, bool inside) {
    Sampled curve;
    for (int i = 0; i < kLambdaCount; ++i) {
      const double lambda = kLambdaMin + i;
      const double band = 1 / (1 + std::exp((from - lambda) / kEdgeWidth)) / (1 + std::exp((lambda - to) / kEdgeWidth));
      curve[i] = 0.1 + 0.6 * (inside ? band : 1 - band);
    }
    result.push_back(curve);
  };
  for (double from = 430; from <= 640; from += 30) {
    add(0, from, true);
    add(from, 2000, true);
    for (double to = from + 60; to <= 640; to += 30) add(from, to, true), add(from, to, false);
  }
  return result;
}

double integral(const Sampled& a, const Sampled& b, const Sampled& c) {
  double sum = 0;
  for (int i = 0; i < kLambdaCount; ++i) sum += a[i] * b[i] * c[i];
  return sum;
}

Sampled ones() {
  Sampled curve;
  curve.fill(1);
  return curve;
}

/// What `curves` measure of `reflectance` under `light`, the light itself giving 1 in curve `unit`.
Xyz measured(const Sampled& reflectance, const Sampled& light, const Curves& curves, const Sampled& unit) {
  const double scale = 1 / integral(ones(), light, unit);
  return {scale * integral(reflectance, light, curves[0]), scale * integral(reflectance, light, curves[1]),
          scale * integral(reflectance, light, curves[2])};
}

/// The matrix M with the least sum of w |M from - to|^2.
class LeastSquares {
 public:
  void add(Xyz from, Xyz to, double weight = 1) {
    const std::array f{from.x, from.y, from.z}, t{to.x, to.y, to.z};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        square_[3 * r + c] += weight * f[r] * f[c];
        mixed_[3 * r + c] += weight * t[r] * f[c];
      }
    }
  }
  Matrix3 solve() const { return mixed_ * inverse(square_); }

 private:
  Matrix3 square_{}, mixed_{};
};

/// Rec.709 to the sensor's signals: of the training reflectances under Rec.709's white, which itself is exact.
Matrix3 sensor_from_rec709(const Curves& sensor, const std::vector<Sampled>& reflectances) {
  constexpr double kWhiteCounts = 1e8;
  const Sampled light = sampled(*named_spectrum("stdillum-D65"));
  LeastSquares fit;
  const auto add = [&](const Sampled& r, double weight) {
    fit.add(rec709_from_xyz() * measured(r, light, observer(), observer()[1]), measured(r, light, sensor, observer()[1]),
            weight);
  };
  for (const Sampled& r : reflectances) add(r, 1);
  add(ones(), kWhiteCounts);
  return fit.solve();
}

/// The sensor's signals under daylight of `kelvin` to what is seen under the film's white; pbrt's scale.
Matrix3 xyz_from_sensor(const Curves& sensor, const std::vector<Sampled>& reflectances, float kelvin,
                        const Sampled& film_light) {
  const Sampled light = sampled(daylight_spectrum(kelvin));
  const double scale = integral(ones(), light, observer()[1]) / integral(ones(), light, sensor[1]);
  LeastSquares fit;
  for (const Sampled& r : reflectances)
    fit.add(measured(r, light, sensor, sensor[1]), scale * measured(r, film_light, observer(), observer()[1]));
  return fit.solve();
}

Xy chromaticity(const Spectrum& light) {
  const Xyz c = measured(ones(), sampled(light), observer(), observer()[1]);
  const double sum = c.x + c.y + c.z;
  return {c.x / sum, c.y / sum};
}

}  // namespace

std::vector<std::string> sensor_names() {
  std::vector<std::string> names{"cie1931"};
  for (const SensorTable& table : sensor_tables()) names.emplace_back(table.name);
  return names;
}

std::optional<Matrix3> sensor_xyz_from_rec709(std::string_view name, float kelvin, Xy film_white) {
  const Matrix3 to_xyz = inverse(rec709_from_xyz());
  if (name == "cie1931") return kelvin > 0 ? adapt_white(chromaticity(daylight_spectrum(kelvin)), film_white) * to_xyz : to_xyz;
  for (const SensorTable& table : sensor_tables()) {
    if (table.name != name) continue;
    const Curves sensor{sampled(table.red), sampled(table.green), sampled(table.blue)};
    const std::vector<Sampled> reflectances = training_reflectances();
    const bool is_d65 = std::abs(film_white.x - kD65.x) < 1e-3;  // the other white of a film is that of ACES
    const Sampled film_light = sampled(*named_spectrum(is_d65 ? "stdillum-D65" : "illum-acesD60"));
    return xyz_from_sensor(sensor, reflectances, kelvin > 0 ? kelvin : 6500, film_light) *
           sensor_from_rec709(sensor, reflectances);
  }
  return std::nullopt;
}

}  // namespace tyndall
