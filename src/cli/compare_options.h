/// The options of `tyndall compare`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/render_options.h"
#include "report/compare.h"

namespace tyndall::cli {

struct CompareOptions {
  std::string scene, folder = "compare-report", reference, progress = "auto";
  std::vector<std::string> variants;
  std::optional<double> time, reference_time, max_memory;
  std::optional<int> spp;
  double reference_error = 1e-3;
  int seeds = 5;
  std::optional<int> threads;
  std::uint64_t seed = 1;
  MethodOptions methods;
  PictureOptions picture;
  bool quiet = false, json = false, denoise = false;
};

void declare(CLI::App& command, CompareOptions& options);

/// What is to be run; `base` is the scene's settings with the options that hold for all. Throws Error (usage).
ComparePlan plan_of(const CompareOptions& options, const RenderSettings& base);

/// The options that hold for all variants, as they were given.
std::string common_options(const CompareOptions& options);

}  // namespace tyndall::cli
