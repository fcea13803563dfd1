/// Frames on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace tyndall::cli {

/// "1-48", "1-48x2" (every second), "48-1" (backwards), and several of these with commas; of a frame that is there twice the
/// first counts. Throws Error (usage) for anything else.
std::vector<int> frames_in(const std::string& list);

void declare_frames(CLI::App& command, std::string& frames);
/// Throws Error (usage) when `name`, which option `option` gives, has no place for a frame's number.
void require_frame_place(const std::string& name, const std::string& option);

}  // namespace tyndall::cli
