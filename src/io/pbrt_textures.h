/// Textures, and parameters that are a texture or a constant.
#pragma once

#include <optional>
#include <string_view>

#include "io/pbrt_colors.h"
#include "io/pbrt_state.h"

namespace tyndall::pbrt {

/// The one texture of this value.
TextureId constant_texture(State& state, Rgb value);

/// A scalar parameter: "float" or "texture" (a float texture).
std::optional<TextureId> find_float_texture(State& state, ParamList& params, std::string_view name);
TextureId float_texture(State& state, ParamList& params, std::string_view name, float otherwise);

/// Types of a colour parameter that may be a texture.
inline constexpr std::initializer_list<ParamType> kColorTextureTypes = {ParamType::rgb, ParamType::spectrum,
                                                                        ParamType::blackbody, ParamType::texture};

/// A colour parameter: rgb, spectrum, blackbody, or "texture" (a spectrum texture).
std::optional<TextureId> find_color_texture(State& state, ParamList& params, std::string_view name, ColorUse use);
/// That of a share of light: a reflectance, a transmittance, an albedo.
TextureId color_texture(State& state, ParamList& params, std::string_view name, Rgb otherwise);

/// Says, at the end of the reading, which named textures nothing has asked for.
void warn_of_idle_textures(State& state);

/// The directive `Texture "name" "float|spectrum" "kind" ...`.
void read_texture(State& state, Tokenizer& in, const Location& where);

}  // namespace tyndall::pbrt
