/// The options of `tyndall render` and what they mean for a scene.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "cli/image_options.h"
#include "cli/method_options.h"
#include "cli/picture_options.h"
#include "tyndall/scene.h"

namespace tyndall::cli {

/// What the command line gave; the scene decides the rest.
struct RenderOptions {
  std::string scene, output;
  MethodOptions methods;
  PictureOptions picture;
  ImageOptions image;
  std::optional<int> spp, threads, deep_bins;
  std::optional<double> time, error, error_max, checkpoint, max_memory, preview_every;
  std::optional<std::uint64_t> seed;
  std::optional<bool> adaptive;
  std::string reference, error_log, aovs, slice, frames, display, deep, progress = "auto";
  std::optional<std::string> serve;  ///< "": where there is room
  bool reproducible = false, quiet = false, json = false, resume = false, denoise = false;

  bool keeps_checkpoints() const { return checkpoint || resume; }
};

void declare_task(CLI::App& command, RenderOptions& options);  ///< what a slice shares with the whole
void declare(CLI::App& command, RenderOptions& options);       ///< all of them
void declare_progress(CLI::App& command, std::string& progress);
void declare_memory(CLI::App& command, std::optional<double>& max_memory);
void declare_scene(CLI::App& command, std::string& scene);

/// Overrides what the scene says: its settings and its film. Throws Error (usage).
void apply(const RenderOptions& options, Scene& scene);
/// Throws Error (usage) for an adaptive render that has no end but its samples, at which all pixels have as many.
void require_end(const RenderSettings& settings);

/// Where the image goes: --output, else what the scene's Film names, else the scene's name with .exr, in the
/// current folder. Throws Error (usage) for an ending that no image is written with, and for image options that do not fit.
std::string output_path(const RenderOptions& options, const Scene& scene);
/// Throws Error (usage) for a name of the deep image that none can have beside `output`.
void require_deep_name(const std::string& deep, const std::string& output);

}  // namespace tyndall::cli
