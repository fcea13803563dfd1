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

}  // namespace

std::string shell_body(const FarmJob& job, const FarmStep& step, const std::string& slice) {
  constexpr std::size_t kWidth = 100;
  std::string text = "program=" + shell_quoted(job.program) + "\nscene=" + shell_quoted(job.scene) +
                     "\nfolder=" + shell_quoted(job.folder) + "\noutput=" + shell_quoted(job.output) + "\n";
  if (step.tasks > 1) text += "slice=" + slice + "\n";
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
