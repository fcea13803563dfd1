#include "math/cie.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int kStep = 5;
constexpr int kTableSize = (kLambdaMax - kLambdaMin) / kStep + 1;

// CIE 1931 2-degree standard observer at 360, 365 ... 830 nm (CIE 15:2004, table T.4).
constexpr std::array<double, kTableSize> kXbar{
    0.0001299,    0.0002321,    0.0004149,    0.0007416,    0.001368,     0.002236,     0.004243,     0.00765,
    0.01431,      0.02319,      0.04351,      0.07763,      0.13438,      0.21477,      0.2839,       0.3285,
    0.34828,      0.34806,      0.3362,       0.3187,       0.2908,       0.2511,       0.19536,      0.1421,
    0.09564,      0.05795001,   0.03201,      0.0147,       0.0049,       0.0024,       0.0093,       0.0291,
    0.06327,      0.1096,       0.1655,       0.2257499,    0.2904,       0.3597,       0.4334499,    0.5120501,
    0.5945,       0.6784,       0.7621,       0.8425,       0.9163,       0.9786,       1.0263,       1.0567,
    1.0622,       1.0456,       1.0026,       0.9384,       0.8544499,    0.7514,       0.6424,       0.5419,
    0.4479,       0.3608,       0.2835,       0.2187,       0.1649,       0.1212,       0.0874,       0.0636,
    0.04677,      0.0329,       0.0227,       0.01584,      0.01135916,   0.008110916,  0.005790346,  0.004109457,
    0.002899327,  0.00204919,   0.001439971,  0.0009999493, 0.0006900786, 0.0004760213, 0.0003323011, 0.0002348261,
    0.0001661505, 0.000117413,  8.307527e-05, 5.870652e-05, 4.150994e-05, 2.935326e-05, 2.067383e-05, 1.455977e-05,
    1.025398e-05, 7.221456e-06, 5.085868e-06, 3.581652e-06, 2.522525e-06, 1.776509e-06, 1.251141e-06};
constexpr std::array<double, kTableSize> kYbar{
    3.917e-06,  6.965e-06,  1.239e-05,  2.202e-05,  3.9e-05,   6.4e-05,   0.00012,    0.000217,   0.000396,   0.00064,
    0.00121,    0.00218,    0.004,      0.0073,     0.0116,    0.01684,   0.023,      0.0298,     0.038,      0.048,
    0.06,       0.0739,     0.09098,    0.1126,     0.13902,   0.1693,    0.20802,    0.2586,     0.323,      0.4073,
    0.503,      0.6082,     0.71,       0.7932,     0.862,     0.9148501, 0.954,      0.9803,     0.9949501,  1.0,
    0.995,      0.9786,     0.952,      0.9154,     0.87,      0.8163,    0.757,      0.6949,     0.631,      0.5668,
    0.503,      0.4412,     0.381,      0.321,      0.265,     0.217,     0.175,      0.1382,     0.107,      0.0816,
    0.061,      0.04458,    0.032,      0.0232,     0.017,     0.01192,   0.00821,    0.005723,   0.004102,   0.002929,
    0.002091,   0.001484,   0.001047,   0.00074,    0.00052,   0.0003611, 0.0002492,  0.0001719,  0.00012,    8.48e-05,
    6e-05,      4.24e-05,   3e-05,      2.12e-05,   1.499e-05, 1.06e-05,  7.4657e-06, 5.2578e-06, 3.7029e-06, 2.6078e-06,
    1.8366e-06, 1.2934e-06, 9.1093e-07, 6.4153e-07, 4.5181e-07};
constexpr std::array<double, kTableSize> kZbar{
    // 0 from 650 nm on
    0.0006061, 0.001086,    0.001946,   0.003486,   0.006450001,  0.01054999, 0.02005001, 0.03621, 0.06785001,  0.1102,
    0.2074,    0.3713,      0.6456,     1.0390501,  1.3856,       1.62296,    1.74706,    1.7826,  1.77211,     1.7441,
    1.6692,    1.5281,      1.28764,    1.0419,     0.8129501,    0.6162,     0.46518,    0.3533,  0.272,       0.2123,
    0.1582,    0.1117,      0.07824999, 0.05725001, 0.04216,      0.02984,    0.0203,     0.0134,  0.008749999, 0.005749999,
    0.0039,    0.002749999, 0.0021,     0.0018,     0.001650001,  0.0014,     0.0011,     0.001,   0.0008,      0.0006,
    0.00034,   0.00024,     0.00019,    0.0001,     4.999999e-05, 3e-05,      2e-05,      1e-05};

/// Cubic Lagrange interpolation of the table: within 1e-3 of the CIE's own 1 nm table point by point, its integrals to 1e-6.
double interpolate(const std::array<double, kTableSize>& table, int lambda) {
  const int offset = lambda - kLambdaMin;
  const int i = std::clamp(offset / kStep - 1, 0, kTableSize - 4);
  const double t = static_cast<double>(offset) / kStep - i;
  return table[i] * (t - 1) * (t - 2) * (t - 3) / -6 + table[i + 1] * t * (t - 2) * (t - 3) / 2 +
         table[i + 2] * t * (t - 1) * (t - 3) / -2 + table[i + 3] * t * (t - 1) * (t - 2) / 6;
}

std::array<Xyz, kLambdaCount> interpolated_functions() {
  std::array<Xyz, kLambdaCount> result;
  for (int i = 0; i < kLambdaCount; ++i) {
    const int lambda = kLambdaMin + i;
    result[i] = {interpolate(kXbar, lambda), interpolate(kYbar, lambda), interpolate(kZbar, lambda)};
  }
  return result;
}

Xyz xyz_of(Xy c) { return {c.x / c.y, 1.0, (1 - c.x - c.y) / c.y}; }

/// Unnormalised: a blue primary may have y < 0 (ACES), and its column's length drops out anyway.
Xyz direction_of(Xy c) { return {c.x, c.y, 1 - c.x - c.y}; }

Matrix3 diagonal(Xyz v) { return {v.x, 0, 0, 0, v.y, 0, 0, 0, v.z}; }

bool close(Vec2 a, Vec2 b) { return std::abs(a.x - b.x) < 1e-3f && std::abs(a.y - b.y) < 1e-3f; }

}  // namespace

const std::array<Xyz, kLambdaCount>& color_matching_functions() {
  static const std::array<Xyz, kLambdaCount> kFunctions = interpolated_functions();
  return kFunctions;
}

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 result{};
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col)
      for (int k = 0; k < 3; ++k) result[3 * row + col] += a[3 * row + k] * b[3 * k + col];
  return result;
}

Matrix3 inverse(const Matrix3& m) {
  const double c0 = m[4] * m[8] - m[5] * m[7], c1 = m[5] * m[6] - m[3] * m[8], c2 = m[3] * m[7] - m[4] * m[6];
  const double s = 1 / (m[0] * c0 + m[1] * c1 + m[2] * c2);
  return {s * c0, s * (m[2] * m[7] - m[1] * m[8]), s * (m[1] * m[5] - m[2] * m[4]),
          s * c1, s * (m[0] * m[8] - m[2] * m[6]), s * (m[2] * m[3] - m[0] * m[5]),
          s * c2, s * (m[1] * m[6] - m[0] * m[7]), s * (m[0] * m[4] - m[1] * m[3])};
}

Xyz operator*(const Matrix3& m, Xyz v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z, m[6] * v.x + m[7] * v.y + m[8] * v.z};
}

std::array<float, 9> to_float(const Matrix3& m) {
  std::array<float, 9> result;
  for (int i = 0; i < 9; ++i) result[i] = static_cast<float>(m[i]);
  return result;
}

Matrix3 xyz_from_rgb(Xy red, Xy green, Xy blue, Xy white) {
  const Xyz r = direction_of(red), g = direction_of(green), b = direction_of(blue);
  const Matrix3 primaries{r.x, g.x, b.x, r.y, g.y, b.y, r.z, g.z, b.z};
  return primaries * diagonal(inverse(primaries) * xyz_of(white));
}

const Matrix3& rec709_from_xyz() {
  static const Matrix3 kMatrix = inverse(xyz_from_rgb({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65));
  return kMatrix;
}

Rgb to_rec709(Xyz c) {
  const Xyz v = rec709_from_xyz() * c;
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Matrix3 adapt_white(Xy from, Xy to) {
  constexpr Matrix3 bradford{0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296};
  const Xyz a = bradford * xyz_of(from), b = bradford * xyz_of(to);
  return inverse(bradford) * diagonal({b.x / a.x, b.y / a.y, b.z / a.z}) * bradford;
}

std::array<float, 9> rec709_from(const Chromaticities& c, bool adapted) {
  const Chromaticities rec709;
  if (close(c.red, rec709.red) && close(c.green, rec709.green) && close(c.blue, rec709.blue) && close(c.white, rec709.white))
    return to_float(kIdentity3);
  const auto xy = [](Vec2 v) { return Xy{v.x, v.y}; };
  const Xy white = close(c.white, rec709.white) ? kD65 : xy(c.white);
  const Matrix3 to_xyz = xyz_from_rgb(xy(c.red), xy(c.green), xy(c.blue), white);
  return to_float(rec709_from_xyz() * (adapted ? adapt_white(white, kD65) * to_xyz : to_xyz));
}

}  // namespace tyndall
