/// Lens files: rows of radius of curvature, thickness, index of refraction and diameter in millimetres, from the scene to the
/// film; a radius of 0 is the stop. What follows a # is a comment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tyndall/scene.h"

namespace tyndall {

/// In metres. Throws Error (scene) with the place in the file.
std::vector<LensElement> read_lens_file(const std::string& path);
/// The same from text; `name` stands for the file in messages.
std::vector<LensElement> read_lens_text(std::string_view text, const std::string& name);

}  // namespace tyndall
