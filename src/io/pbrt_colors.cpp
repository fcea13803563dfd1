#include "io/pbrt_colors.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/file_text.h"
#include "math/cie.h"

namespace tyndall::pbrt {
namespace {

Error wrong(const Param& p, const std::string& what) { return Error(p.where, "parameter \"" + p.name + "\" " + what); }

Rgb convert_rgb(Reports& reports, const Param& p, Rgb c, ColorUse use) {
  if (c.r < 0 || c.g < 0 || c.b < 0) throw wrong(p, "has a negative component; use values >= 0");
  if (use == ColorUse::light) return transformed(p.color_space->to_rec709, c);
  if (use == ColorUse::albedo && max_component(c) > 1) throw wrong(p, "has a component above 1; a reflectance is at most 1");
  // Colours of a wide space may lie outside Rec.709.
  const Rgb rec709 = transformed(p.color_space->reflectance_to_rec709, c);
  const Rgb kept = clamp(rec709, 0, use == ColorUse::albedo ? 1.0f : kInfinity);
  const Rgb off = rec709 - kept;
  constexpr float kVisible = 0.005f;
  if (std::max({std::abs(off.r), std::abs(off.g), std::abs(off.b)}) > kVisible)
    reports.warn(p.where,
                 "colours of this ColorSpace lie outside Rec.709, in which Tyndall renders: they are clamped, and paler than "
                 "pbrt-v4 shows them");
  return kept;
}

Rgb convert_spectrum(const Spectrum& spectrum, ColorUse use) {
  return use == ColorUse::light ? illuminant_rgb(spectrum) : reflectance_rgb(spectrum);
}

Spectrum from_pairs(const Param& p, const std::vector<float>& numbers) {
  if (numbers.size() % 2 != 0) throw wrong(p, "has an odd number of values; a spectrum is pairs of wavelength and value");
  Spectrum spectrum;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    if (!spectrum.lambda.empty() && !(numbers[i] > spectrum.lambda.back()))
      throw wrong(p, "has wavelengths out of order; sort the pairs by wavelength");
    if (numbers[i + 1] < 0) throw wrong(p, "has a negative value; use values >= 0");
    spectrum.lambda.push_back(numbers[i]);
    spectrum.value.push_back(numbers[i + 1]);
  }
  if (spectrum.lambda.empty()) throw wrong(p, "is an empty spectrum; give pairs of wavelength and value");
  return spectrum;
}

Spectrum from_file(State& state, const Param& p) {
  const std::string path = resolve_asset(state, p.where, p.strings[0]);
  Tokenizer in(read_file_text(path), path);
  std::vector<float> numbers;
  in.append_numbers(numbers);
  const Token rest = in.next();
  if (!rest.is(Token::Kind::end)) throw in.error(rest.at, "expected a number, found " + shown(rest));
  return from_pairs(p, numbers);
}

/// Colours of names and temperatures are kept: a million lights of one temperature are integrated once.
template <typename Make>
Rgb cached(State& state, const std::string& key, Make make) {
  const auto it = state.spectrum_colors.find(key);
  if (it != state.spectrum_colors.end()) return it->second;
  return state.spectrum_colors[key] = make();
}

std::string cache_key(char kind, std::string_view text, ColorUse use) {
  return std::string{kind, static_cast<char>('0' + static_cast<int>(use))} + std::string(text);
}

}  // namespace

Spectrum to_spectrum(State& state, const Param& param) {
  if (param.strings.empty()) return from_pairs(param, param.numbers);
  if (param.strings.size() > 1) throw wrong(param, "names more than one spectrum; give one");
  if (const auto named = named_spectrum(param.strings[0])) return *named;
  try {
    return from_file(state, param);
  } catch (const Error& e) {
    throw Error(param.where, "\"" + printable(param.strings[0]) +
                                 "\" is neither a named spectrum (as \"metal-Cu-eta\") nor a readable spectrum file (" +
                                 e.what() + ")");
  }
}

Rgb to_color(State& state, const Param& param, ColorUse use) {
  if (param.type == ParamType::rgb) {
    if (param.numbers.size() != 3) throw wrong(param, "has more than one colour; give three values");
    return convert_rgb(state.reports, param, {param.numbers[0], param.numbers[1], param.numbers[2]}, use);
  }
  if (param.type == ParamType::blackbody) {
    if (param.numbers.size() != 1) throw wrong(param, "has more than one value; a blackbody is a temperature in kelvin");
    const float kelvin = param.numbers[0];
    if (!(kelvin > 0)) throw wrong(param, "is no temperature; give kelvin above 0");
    return cached(state, cache_key('k', std::to_string(std::bit_cast<std::uint32_t>(kelvin)), use),
                  [&] { return convert_spectrum(blackbody_spectrum(kelvin), use); });
  }
  if (param.strings.size() != 1) return convert_spectrum(to_spectrum(state, param), use);
  return cached(state, cache_key('n', param.strings[0], use), [&] { return convert_spectrum(to_spectrum(state, param), use); });
}

std::optional<Rgb> find_color(State& state, ParamList& params, std::string_view name, ColorUse use) {
  const Param* p = params.find(name, {ParamType::rgb, ParamType::spectrum, ParamType::blackbody});
  if (!p) return std::nullopt;
  return to_color(state, *p, use);
}

std::vector<Rgb> find_colors(ParamList& params, std::string_view name, ColorUse use) {
  std::vector<Rgb> colors;
  const Param* p = params.find(name, {ParamType::rgb});
  if (!p) return colors;
  colors.reserve(p->numbers.size() / 3);
  for (std::size_t i = 0; i < p->numbers.size(); i += 3)
    colors.push_back(convert_rgb(params.reports(), *p, {p->numbers[i], p->numbers[i + 1], p->numbers[i + 2]}, use));
  return colors;
}

Rgb light_color(State& state, ParamList& params, std::string_view name) {
  if (const auto color = find_color(state, params, name, ColorUse::light)) return *color;
  return transformed(state.graphics.color_space->to_rec709, Rgb(1.0f));
}

RefractiveIndex find_refractive_index(State& state, ParamList& params, std::string_view name) {
  const Param* p = params.find(name, {ParamType::number, ParamType::spectrum});
  if (!p) return {};
  RefractiveIndex index;
  if (p->type == ParamType::number) {
    if (p->numbers.size() != 1) throw wrong(*p, "has more than one value; give one");
    index.eta = p->numbers[0];
  } else {
    const Spectrum spectrum = to_spectrum(state, *p);
    const Rgb rgb = reflectance_rgb(spectrum);
    const auto [low, high] = std::minmax_element(spectrum.value.begin(), spectrum.value.end());
    index.eta = luminance(rgb);
    if (*low != *high && rgb.r > 0 && rgb.g > 0 && rgb.b > 0) index.rgb = rgb;
  }
  if (!(index.eta > 0)) throw wrong(*p, "is no index of refraction; give a value above 0");
  return index;
}

float find_eta(State& state, ParamList& params, std::string_view name) {
  const RefractiveIndex index = find_refractive_index(state, params, name);
  if (index.rgb)
    params.reports().warn(params.where(name), "index of refraction varies with wavelength; its mean " +
                                                  std::to_string(index.eta) + " is used, without dispersion");
  return index.eta;
}

}  // namespace tyndall::pbrt
