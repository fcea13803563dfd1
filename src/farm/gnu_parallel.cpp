#include <fmt/core.h>

#include "farm/farm_job.h"
#include "farm/shell_step.h"
#include "report/shell_quote.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Twice quoted: parallel gives its arguments to a shell once more. `sh FILE {}`, where it puts the slice for {}.
std::string array_line(const FarmJob& job, const FarmStep& step) {
  std::string options;
  for (const std::string& option : job.engine_options) options += " " + shell_quoted(option);
  return fmt::format(
      "parallel --jobs 1 --retries 3 --joblog logs/{0}.txt --line-buffer --tagstring '{0} {{}}'{1} \\\n"
      "  sh {2} {{}} ::: $(seq 1 {3}) || echo \"some tasks of {0} failed; see logs/{0}.txt\" >&2\n",
      step.name, options, shell_quoted(shell_quoted(job.folder + "/" + step.name + ".sh")), step.tasks());
}

std::string run_script(const FarmJob& job) {
  std::string text =
      "#!/bin/sh\n"
      "# One task at a time on each machine, with all its cores, unless an option says otherwise. To be run again as often as "
      "you\n"
      "# like: slices that are there end at once, those that were stopped go on.\n"
      "set -u\n"
      "cd " +
      shell_quoted(job.folder) + " || exit 1\n";
  for (const FarmStep& step : job.steps) {
    if (step.tasks() > 1) text += array_line(job, step);
    if (step.tasks() == 1) text += "sh " + step.name + ".sh\n";
  }
  return text;
}

}  // namespace

FarmFiles parallel_files(const FarmJob& job) {
  if (job.folder.find('{') != std::string::npos)
    throw Error(Failure::usage,
                "parallel puts slices in place of braces, which " + job.folder + " has; choose another --folder");
  FarmFiles result;
  for (const FarmStep& step : job.steps)
    result.files.push_back({step.name + ".sh", "#!/bin/sh\n" + shell_body(job, step, "$1")});
  result.files.push_back({"run.sh", run_script(job)});
  result.start = "sh " + shell_quoted(job.folder + "/run.sh");
  return result;
}

}  // namespace tyndall
