/// The options of `tyndall render` and what they mean for a scene.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "tyndall/scene.h"

namespace tyndall::cli {

/// What the command line gave; the scene decides the rest.
struct RenderOptions {
  std::string scene, output;
  std::optional<int> spp, max_depth, threads;
  std::optional<double> time, error;
  std::optional<std::uint64_t> seed;
  std::string crop, resolution, lights, transmittance, aovs, progress = "auto";
  bool sanitize = false, reproducible = false, quiet = false, json = false;
};

void declare(CLI::App& command, RenderOptions& options);

/// Override what the scene says: its settings and its film. Throws Error (usage).
void apply(const RenderOptions& options, Scene& scene);

/// Where the image goes: --output, else what the scene's Film names, else the scene's name with .exr, in the
/// current folder. Throws Error (usage) for an ending that is neither .exr nor .png.
std::string output_path(const RenderOptions& options, const Scene& scene);

}  // namespace tyndall::cli
