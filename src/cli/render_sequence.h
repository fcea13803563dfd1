/// `render --frames`: a picture for each frame.
#pragma once

#include <string>
#include <vector>

#include "cli/render_options.h"

namespace tyndall::cli {

/// Renders the frames one after the other. What a frame shares with the one before is not read or built again. Before anything
/// is rendered it is looked for all files of all frames. Returns the exit code. Throws Error.
int render_sequence(const RenderOptions& options, const std::string& command_line);

}  // namespace tyndall::cli
