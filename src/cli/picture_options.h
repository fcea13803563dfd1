/// The options that say what the right picture is.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "tyndall/scene.h"

namespace tyndall::cli {

struct PictureOptions {
  std::optional<int> max_depth;
  std::string crop, resolution;
  bool sanitize = false;
};

void declare(CLI::App& command, PictureOptions& options);
/// Overrides what the scene says: its settings and its film. Throws Error (usage).
void apply(const PictureOptions& options, Scene& scene);

}  // namespace tyndall::cli
