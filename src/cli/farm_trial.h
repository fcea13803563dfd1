/// What a task of a farm will take, from a few samples rendered here.
#pragma once

#include <optional>
#include <string>

#include "tyndall/scene.h"

namespace tyndall::cli {

struct FarmTrial {
  double build_seconds = 0;   ///< that every task spends before its first sample: reading, building, looking at the film
  double sample_seconds = 0;  ///< a sample of every pixel
  int threads = 1;
  std::size_t memory = 0;  ///< bytes that the process held at most
};

/// Reads, builds and renders for a few seconds, with progress. `sanitize` as for build(). Throws what these throw.
FarmTrial try_out(Scene scene, bool sanitize, double read_seconds, const std::string& progress);

/// How many slices keep building below a tenth of their time, at least 1; for slices that each have `time` seconds there is no
/// such number.
int most_slices(const FarmTrial& trial, int spp);

/// What is to be said of it, with advice where building takes more than a tenth.
std::string as_text(const FarmTrial& trial, const RenderSettings& settings, int slices);

}  // namespace tyndall::cli
