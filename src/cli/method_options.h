/// The options that choose between methods.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "tyndall/scene.h"

namespace tyndall::cli {

/// Any of them gives the same picture, sooner or later.
struct MethodOptions {
  std::vector<std::string> strategies = std::vector<std::string>(strategy_axes().size());  ///< by axis; empty: not given

  std::optional<int> candidates, shadow_rays;
  std::optional<double> splitting;
};

void declare(CLI::App& command, MethodOptions& options);
/// Overrides what the scene says. Throws Error (usage).
void apply(const MethodOptions& options, RenderSettings& settings);

}  // namespace tyndall::cli
