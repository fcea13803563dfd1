#include "cli/notes.h"

#include <fmt/core.h>

namespace tyndall::cli {

std::string notes_text(const std::string& scene, const std::vector<Warning>& warnings, const BuildSummary& build) {
  std::string text;
  for (const Warning& w : warnings)
    text += fmt::format("{}: warning: {}\n", w.where.file.empty() ? scene : w.where.str(), w.message);
  for (const std::string& note : build.notes) text += fmt::format("{}: note: {}\n", scene, note);
  return text;
}

}  // namespace tyndall::cli
