#include "io/color.h"

#include <algorithm>
#include <cmath>

#include "math/cie.h"

namespace tyndall {
namespace {

/// Integral of the colour matching functions times the spectrum, nm.
Xyz integrate(const Sampled& s) {
  const auto& cmf = color_matching_functions();
  Xyz sum;
  for (int k = 0; k < kLambdaCount; ++k) sum = sum + s[k] * cmf[k];
  return sum;
}

const Sampled& d65() {
  static const Sampled kValues = sampled(*named_spectrum("stdillum-D65"));
  return kValues;
}

/// A reflectance's colour under D65. Dividing by the white's own rgb makes a constant spectrum grey to the last bit
/// that double precision has.
Rgb under_d65(const Sampled& reflectance) {
  Sampled product;
  for (int k = 0; k < kLambdaCount; ++k) product[k] = reflectance[k] * d65()[k];
  static const Xyz kWhite = rec709_from_xyz() * integrate(d65());
  const Xyz c = rec709_from_xyz() * integrate(product);
  const auto channel = [](double value, double of_white) { return static_cast<float>(std::max(value / of_white, 0.0)); };
  return {channel(c.x, kWhite.x), channel(c.y, kWhite.y), channel(c.z, kWhite.z)};
}

}  // namespace

Sampled sampled(const Spectrum& s) {
  Sampled result{};
  const std::size_t n = std::min(s.lambda.size(), s.value.size());
  if (n == 0) return result;
  if (n == 1) {
    result.fill(s.value[0]);
    return result;
  }
  std::size_t i = 0;  // of the segment [i, i + 1] that holds lambda
  for (int k = 0; k < kLambdaCount; ++k) {
    const double lambda = kLambdaMin + k;
    if (lambda < s.lambda.front() || lambda > s.lambda[n - 1]) continue;
    while (i + 2 < n && s.lambda[i + 1] < lambda) ++i;
    const double width = static_cast<double>(s.lambda[i + 1]) - s.lambda[i];
    const double t = width > 0 ? std::clamp((lambda - s.lambda[i]) / width, 0.0, 1.0) : 0.0;
    result[k] = (1 - t) * s.value[i] + t * s.value[i + 1];
  }
  return result;
}

Rgb reflectance_rgb(const Spectrum& spectrum) {
  const auto& v = spectrum.value;
  if (v.empty()) return {};
  // However far it reaches: "400 c 700 c" is meant to be grey.
  if (std::all_of(v.begin(), v.end(), [&](float x) { return x == v.front(); })) return Rgb(v.front());
  return under_d65(sampled(spectrum));
}

Rgb illuminant_rgb(const Spectrum& spectrum) {
  const Xyz c = integrate(sampled(spectrum));
  return c.y > 0 ? to_rec709((1 / c.y) * c) : Rgb();
}

Rgb radiance_rgb(const Spectrum& spectrum) { return to_rec709(integrate(sampled(spectrum))); }

ConductorRgb conductor_rgb(const Spectrum& eta, const Spectrum& k) {
  const Sampled n = sampled(eta), extinction = sampled(k);
  Sampled reflectance;
  for (int i = 0; i < kLambdaCount; ++i) {
    const double k2 = extinction[i] * extinction[i];
    reflectance[i] = ((n[i] - 1) * (n[i] - 1) + k2) / ((n[i] + 1) * (n[i] + 1) + k2);
  }
  const Rgb r0 = under_d65(reflectance);
  ConductorRgb result{reflectance_rgb(eta), {}};
  for (int c = 0; c < 3; ++c) {
    // r (n + 1)^2 + r k^2 = (n - 1)^2 + k^2, solved for k; when no k >= 0 fits, for n at k = 0.
    const double r = std::clamp(static_cast<double>(r0[c]), 0.0, 0.9999), m = result.eta[c];
    const double k2 = (r * (m + 1) * (m + 1) - (m - 1) * (m - 1)) / (1 - r);
    result.k[c] = static_cast<float>(std::sqrt(std::max(k2, 0.0)));
    if (k2 < 0) result.eta[c] = static_cast<float>((1 + std::sqrt(r)) / (1 - std::sqrt(r)));
  }
  return result;
}

}  // namespace tyndall
