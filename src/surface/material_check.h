/// What a list of materials must satisfy before it can be evaluated.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tyndall/scene.h"

namespace tyndall {

/// Calls `visit` for every texture that the material names; a mix names its amount alone.
void for_each_texture(const Material& material, const std::function<void(TextureId)>& visit);

/// Throws Error (scene) at the place of the first material with a texture or material index out of range, an index
/// of refraction that is not positive and finite, or a mix that contains itself.
void check_materials(const std::vector<Material>& materials, std::size_t texture_count);

}  // namespace tyndall
