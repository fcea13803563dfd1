#include "farm/shell_step.h"

#include <regex>

#include "report/shell_quote.h"

namespace tyndall {
namespace {

std::string shell_word(const FarmWord& word) {
  if (!word.is_template) return shell_quoted(word.text);
  static const std::regex kName("\\{([a-z]+)\\}");
  return "\"" + std::regex_replace(word.text, kName, "$${$1}") + "\"";
}

/// The slice and the frame that a task is for.
std::string numbers_text(const FarmStep& step, const std::string& task) {
  if (step.frames.empty()) return step.tasks() > 1 ? "slice=" + task + "\n" : "";
  if (step.tasks() == 1) return "slice=1\nframe=" + std::to_string(step.frames.front()) + "\n";
  const std::string slices = std::to_string(step.slices);
  std::string text = "task=" + task + "\nslice=$(((task - 1) % " + slices + " + 1))\nset --";
  for (const int frame : step.frames) text += " " + std::to_string(frame);
  return text + "\nshift $(((task - 1) / " + slices + "))\nframe=$1\n";
}

}  // namespace

std::string shell_body(const FarmJob& job, const FarmStep& step, const std::string& task) {
  constexpr std::size_t kWidth = 100;
  std::string text = "program=" + shell_quoted(job.program) + "\nscene=" + shell_quoted(job.scene) +
                     "\nfolder=" + shell_quoted(job.folder) + "\noutput=" + shell_quoted(job.output) + "\n";
  text += numbers_text(step, task);
  text += "\nexec";
  std::size_t column = 4;
  for (const FarmWord& word : step.command) {
    const std::string next = shell_word(word);
    if (column + next.size() > kWidth) {
      text += " \\\n ";
      column = 2;
    }
    text += " " + next;
    column += 1 + next.size();
  }
  return text + "\n";
}

}  // namespace tyndall
