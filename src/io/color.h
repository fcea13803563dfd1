/// Spectra and colour spaces of scene files, turned into the linear Rec.709 RGB that Tyndall renders with.
///
/// pbrt is spectral and Tyndall is not; each kind of quantity is reduced so that a grey scene agrees exactly
/// and a coloured one as closely as three numbers can. See the functions, and reflectance_to_rec709 below.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "math/cie.h"
#include "tyndall/color.h"
#include "tyndall/image.h"
#include "tyndall/math.h"

namespace tyndall {

/// Piecewise linear over wavelengths in nm, ascending. Constant when it has one sample; 0 outside its range, as in pbrt.
struct Spectrum {
  std::vector<float> lambda, value;
};

/// Values at each whole nm of the observer's range.
using Sampled = std::array<double, kLambdaCount>;
Sampled sampled(const Spectrum& s);

/// pbrt-v4's named spectra: "metal-Cu-eta", "metal-Cu-k", "glass-BK7", "stdillum-D65", "illum-acesD60" ...
std::optional<Spectrum> named_spectrum(std::string_view name);

/// Planck's law over 360..830 nm divided by its peak (Wien), as pbrt's BlackbodySpectrum; all 0 for kelvin <= 0.
Spectrum blackbody_spectrum(float kelvin);

/// Daylight of that correlated colour temperature [CIE 15:2004, 3.1], below 4000 K a black body; as pbrt has it, whose kelvin
/// are those of the illuminants' old c2.
Spectrum daylight_spectrum(float kelvin);

/// For eta, k, sigma_a, sigma_s and reflectances: the colour seen under D65, Rec.709's white, clamped to >= 0.
/// A constant spectrum c gives exactly Rgb(c).
Rgb reflectance_rgb(const Spectrum& spectrum);

/// For lights and emission: scaled to luminance Y = 1, as pbrt divides a light's spectrum by its photometric Y;
/// "scale" and "power" multiply afterwards. Black when Y is 0. May have slightly negative channels (out of gamut).
Rgb illuminant_rgb(const Spectrum& spectrum);

/// Emission as pbrt's film (sensor "cie1931") shows it: integral of cmf * L over 360..830 nm, not normalised.
Rgb radiance_rgb(const Spectrum& spectrum);

/// A metal's complex index of refraction, one value a channel.
struct ConductorRgb {
  Rgb eta, k;
};
/// eta and k such that each channel's reflectance at normal incidence is the colour of the spectral reflectance
/// under D65. Averaging eta and k themselves would not give that, since Fresnel's formula is not linear in them:
/// eta is the averaged one, and k follows from the reflectance (eta is changed where no k >= 0 fits).
ConductorRgb conductor_rgb(const Spectrum& eta, const Spectrum& k);

enum class ColorSpaceId { srgb, rec2020, aces2065_1, dci_p3 };

/// An RGB colour space. The two matrices are pure changes of basis, with no white adaptation: as in pbrt, light of
/// rgb (1,1,1) is the space's own white, so ACES light is yellowish in Rec.709. Use them for emission and for the film.
struct ColorSpace {
  ColorSpaceId id;
  std::array<float, 9> to_rec709, from_rec709;  ///< row-major
  Chromaticities chromaticities;
  /// For reflectances, sigma_a, sigma_s and their textures: as to_rec709 but adapted (Bradford), since a reflectance
  /// of (1,1,1) is a perfect white under any light. Equal to to_rec709 in all spaces whose white is D65.
  std::array<float, 9> reflectance_to_rec709;
};

/// "srgb", "rec2020", "aces2065-1" or "dci-p3" (with white D65, as in pbrt); null for other names.
const ColorSpace* find_color_space(std::string_view name);

}  // namespace tyndall
