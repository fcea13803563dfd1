/// Colour parameters: rgb, spectrum and blackbody values as linear Rec.709.
#pragma once

#include <optional>
#include <string_view>

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

/// What a colour is for decides how it is reduced to three numbers and which range it may have.
enum class ColorUse {
  albedo,     ///< reflectances: within [0,1]
  unbounded,  ///< sigma_a, sigma_s, eta, k: >= 0
  light,      ///< emission, spectra scaled to luminance 1 as pbrt does
};

/// The colour, or empty when the parameter is absent. Error for more than one value.
std::optional<Rgb> find_color(State& state, ParamList& params, std::string_view name, ColorUse use);
/// A parameter of type rgb, spectrum or blackbody that has been found already.
Rgb to_color(State& state, const Param& param, ColorUse use);
/// All triples of an "rgb" array parameter (grids).
std::vector<Rgb> find_colors(ParamList& params, std::string_view name, ColorUse use);
/// The light's colour at `name`, or the white of the colour space in force.
Rgb light_color(State& state, ParamList& params, std::string_view name);

/// A parameter of type spectrum as such: pairs, a named spectrum, or a file of pairs.
Spectrum to_spectrum(State& state, const Param& param);

/// An index of refraction; of one that varies with wavelength the luminance's, and each channel's.
struct RefractiveIndex {
  float eta = 1.5f;
  std::optional<Rgb> rgb;
};
/// "float", or a spectrum.
RefractiveIndex find_refractive_index(State& state, ParamList& params, std::string_view name);
/// The same where nothing disperses: with a warning when it would.
float find_eta(State& state, ParamList& params, std::string_view name);

}  // namespace tyndall::pbrt
