/// Measured spectra: numbers only. Sources stand in spectrum_data.cpp.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace tyndall {

/// A table over wavelengths in nm.
struct SpectrumTable {
  std::string_view name;
  std::span<const float> lambda, value;
};

/// Silver, aluminium, gold, copper: 56 samples at photon energies 4.15, 4.10 ... 1.40 eV.
struct MetalTable {
  std::string_view name;
  std::array<float, 56> value;
};
std::span<const MetalTable> metal_tables();

/// Brass, MgO and TiO2, each over wavelengths of its own.
std::span<const SpectrumTable> other_metal_tables();

/// n^2 = 1 + sum b_i l^2 / (l^2 - c_i), l in micrometres [Sellmeier].
struct GlassFormula {
  std::string_view name;
  std::array<double, 3> b, c;
  float lambda_min, lambda_max;  ///< nm
};
std::span<const GlassFormula> glass_formulas();

/// CIE daylight components S0, S1, S2 at 300, 310 ... 830 nm.
inline constexpr int kDaylightCount = 54;
extern const std::array<float, kDaylightCount> kDaylight[3];

/// CIE fluorescent illuminants F1 ... F12 at 380, 385 ... 780 nm.
inline constexpr int kFluorescentCount = 81;
extern const std::array<float, kFluorescentCount> kFluorescent[12];

}  // namespace tyndall
