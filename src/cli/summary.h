/// The closing summary of a render, as text and as JSON.
#pragma once

#include <optional>
#include <string>

#include "tyndall/denoise.h"
#include "tyndall/render.h"

namespace tyndall::cli {

struct Summary {
  std::string output;
  double read_seconds = 0, build_seconds = 0, write_seconds = 0;
  BuildSummary build;
  RenderReport render;
  int width = 0, height = 0;  ///< pixels rendered
  std::optional<DenoiseReport> denoised;
};

std::string as_text(const Summary& summary);
std::string as_json(const Summary& summary);
/// Most memory the process has held, bytes.
std::size_t peak_memory();

}  // namespace tyndall::cli
