/// Putting things into a Scene by hand: names looked up, and what takes several entries made in one step.
#pragma once

#include <string>
#include <string_view>

#include "tyndall/scene.h"

namespace tyndall {

/// Adds `medium` and its boundary: a closed box without optical effect around `bounds`, which are in medium space. What is
/// outside of the box stays: other media overlap. Throws Error (usage) when the box has no volume, or a medium of this name
/// is there already.
MediumId add_medium(Scene& scene, Medium medium, const Bounds3& bounds);

/// The medium of this name. Throws Error (usage), with the names that there are, when there is none.
MediumId medium_named(const Scene& scene, std::string_view name);

/// Adds a diffuse material of constant reflectance. Throws Error (usage) when one of this name is there already.
MaterialId add_diffuse_material(Scene& scene, std::string name, Rgb reflectance);

/// The material of this name. Throws Error (usage), with the names that there are, when there is none.
MaterialId material_named(const Scene& scene, std::string_view name);

}  // namespace tyndall
