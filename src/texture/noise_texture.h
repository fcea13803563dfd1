/// Textures that are sums of noise, as pbrt has them.
#pragma once

#include "texture/mapping.h"

namespace tyndall {

/// The value at a point; octaves that are finer than the query's footprint fade out.
Rgb noise_texture(const NoiseTexture& texture, const TextureQuery& query);

}  // namespace tyndall
