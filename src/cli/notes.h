/// What a user should know of a scene that is sound.
#pragma once

#include <string>
#include <vector>

#include "tyndall/io.h"
#include "tyndall/render.h"

namespace tyndall::cli {

/// A line each, "hall.pbrt:3:1: warning: ..." and "hall.pbrt: note: ...": warnings of the reader and notes of the build. What
/// has no place of its own gets `scene`, the path of the scene.
std::string notes_text(const std::string& scene, const std::vector<Warning>& warnings, const BuildSummary& build);

}  // namespace tyndall::cli
