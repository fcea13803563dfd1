#include <cmath>
#include <string>

#include "io/color.h"
#include "io/spectrum_data.h"
#include "math/blackbody.h"
#include "math/cie.h"

namespace tyndall {
namespace {

std::optional<Spectrum> metal(std::string_view name) {
  for (const MetalTable& table : metal_tables()) {
    if (table.name != name) continue;
    Spectrum result;
    for (std::size_t i = 0; i < table.value.size(); ++i) {
      const double energy = 4.15 - 0.05 * static_cast<double>(i);          // eV
      result.lambda.push_back(static_cast<float>(1239.8417571 / energy));  // h c / e in nm eV
      result.value.push_back(table.value[i]);
    }
    return result;
  }
  for (const SpectrumTable& table : other_metal_tables())
    if (table.name == name)
      return Spectrum{{table.lambda.begin(), table.lambda.end()}, {table.value.begin(), table.value.end()}};
  return {};
}

std::optional<Spectrum> glass(std::string_view name) {
  constexpr float step = 5;
  for (const GlassFormula& formula : glass_formulas()) {
    const bool also_sf = name.starts_with("glass-S") && name.substr(7) == formula.name.substr(6);  // "glass-SF5"
    if (formula.name != name && !also_sf) continue;
    Spectrum result;
    for (float lambda = formula.lambda_min; lambda < formula.lambda_max + step; lambda += step) {
      const double l2 = lambda * lambda * 1e-6;
      double n2 = 1;
      for (int i = 0; i < 3; ++i) n2 += formula.b[i] * l2 / (l2 - formula.c[i]);
      result.lambda.push_back(lambda);
      result.value.push_back(static_cast<float>(std::sqrt(n2)));
    }
    return result;
  }
  return {};
}

/// S0 + m1 S1 + m2 S2 [CIE 15:2004, 3.1], linear between the components' 10 nm samples.
Spectrum daylight(float m1, float m2) {
  Spectrum result;
  for (int i = 0; i < kDaylightCount; ++i) {
    result.lambda.push_back(300.0f + 10.0f * static_cast<float>(i));
    result.value.push_back(kDaylight[0][i] + m1 * kDaylight[1][i] + m2 * kDaylight[2][i]);
  }
  return result;
}

/// The CIE's definition of A: a black body at 2848 K with c2 = 0.01435 m K, 100 at 560 nm.
Spectrum illuminant_a() {
  Spectrum result;
  for (int lambda = 300; lambda <= 830; lambda += 5) {
    const double value =
        100 * std::pow(560.0 / lambda, 5) * std::expm1(1.435e7 / (2848 * 560.0)) / std::expm1(1.435e7 / (2848.0 * lambda));
    result.lambda.push_back(static_cast<float>(lambda));
    result.value.push_back(static_cast<float>(value));
  }
  return result;
}

std::optional<Spectrum> illuminant(std::string_view name) {
  if (name == "stdillum-A") return illuminant_a();
  if (name == "stdillum-D50") return daylight(-1.040f, 0.367f);
  if (name == "stdillum-D65") return daylight(-0.295f, -0.689f);
  if (name == "illum-acesD60") return daylight(-0.536f, -0.519f);
  for (int f = 1; f <= 12; ++f) {
    if (name != "stdillum-F" + std::to_string(f)) continue;
    Spectrum result;
    for (int i = 0; i < kFluorescentCount; ++i) {
      result.lambda.push_back(380.0f + 5.0f * static_cast<float>(i));
      result.value.push_back(kFluorescent[f - 1][i]);
    }
    return result;
  }
  return {};
}

}  // namespace

std::optional<Spectrum> named_spectrum(std::string_view name) {
  if (name.starts_with("metal-")) return metal(name);
  if (name.starts_with("glass-")) return glass(name);
  return illuminant(name);
}

Spectrum daylight_spectrum(float kelvin) {
  const double t = kelvin * 1.4388 / 1.4380;
  if (t < 4000) return blackbody_spectrum(static_cast<float>(t));
  const double x = t <= 7000 ? ((-4.6070e9 / t + 2.9678e6) / t + 0.09911e3) / t + 0.244063
                             : ((-2.0064e9 / t + 1.9018e6) / t + 0.24748e3) / t + 0.237040;
  const double y = (-3 * x + 2.87) * x - 0.275;
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  return daylight(static_cast<float>((-1.3515 - 1.7703 * x + 5.9114 * y) / m),
                  static_cast<float>((0.03 - 31.4424 * x + 30.0717 * y) / m));
}

Spectrum blackbody_spectrum(float kelvin) {
  Spectrum result;
  for (int lambda = kLambdaMin; lambda <= kLambdaMax; ++lambda) {
    result.lambda.push_back(static_cast<float>(lambda));
    result.value.push_back(static_cast<float>(normalized_blackbody(lambda, kelvin)));
  }
  return result;
}

}  // namespace tyndall
