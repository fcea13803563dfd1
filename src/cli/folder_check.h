/// Whether scenes read and build, one of them or all below a folder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tyndall/io.h"
#include "tyndall/render.h"

namespace tyndall::cli {

struct Verdict {
  std::string path;
  std::optional<int> frame;         ///< of a sequence
  std::vector<std::string> errors;  ///< with their places, best first
  std::vector<Warning> warnings;    ///< of each kind the first
  BuildSummary build;
  bool by_frame = false;  ///< other frames name other files
  bool ok() const { return errors.empty(); }
  std::string name() const { return frame ? path + ", frame " + std::to_string(*frame) : path; }
};
Verdict verdict_on(const std::string& path, const SceneReading& how = {});

/// Paths of the .pbrt and .pbrt.gz below `folder` that have a WorldBegin, sorted: others are there to be included. Throws
/// Error (scene) when there is none.
std::vector<std::string> scenes_below(const std::string& folder);

/// One after the other; `show`: as a table with a row when each is done, then counts of scenes and of kinds of warnings.
std::vector<Verdict> check_all(const std::vector<std::string>& scenes, bool show);
void print_json(const std::vector<Verdict>& verdicts);

}  // namespace tyndall::cli
