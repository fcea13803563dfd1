#include <fmt/core.h>

#include "farm/farm_job.h"
#include "farm/shell_step.h"
#include "report/shell_quote.h"

namespace tyndall {
namespace {

std::string directives(const FarmJob& job, const FarmStep& step) {
  const bool array = step.tasks() > 1;
  std::string text;
  const auto add = [&](const std::string& option) { text += "#SBATCH " + option + "\n"; };
  add("--job-name=" + job.name + "-" + step.name);
  if (array) add(fmt::format("--array=1-{}", step.tasks()));
  add(fmt::format("--cpus-per-task={}", step.threads));
  add(fmt::format("--mem={}M", (step.memory >> 20) + 1));
  // Preempted, requeued or out of time: two minutes to save, then again from there.
  add("--requeue");
  add("--signal=B:TERM@120");
  add("--open-mode=append");
  add("--output=logs/" + step.name + (array ? "-%a" : "") + ".log");
  for (const std::string& option : job.engine_options) add(option);
  return text;
}

std::string step_script(const FarmJob& job, const FarmStep& step) {
  return "#!/bin/sh\n" + directives(job, step) + "\n" + shell_body(job, step, "$SLURM_ARRAY_TASK_ID");
}

std::string submit_script(const FarmJob& job) {
  std::string text =
      "#!/bin/sh\n"
      "# Submits the steps; each begins when all tasks of the one before have ended, in whatever way. To be run again as "
      "often\n"
      "# as you like: slices that are there end at once, those that were stopped go on.\n"
      "set -eu\n"
      "cd " +
      shell_quoted(job.folder) + "\n";
  std::string before;
  for (const FarmStep& step : job.steps) {
    const std::string after = before.empty() ? "" : " --dependency=\"afterany:${" + before + "%%;*}\"";
    text += fmt::format("{}=$(sbatch --parsable{} {}.sbatch)\n", step.name, after, step.name);
    text += fmt::format("echo \"{}: job ${{{}%%;*}}\"\n", step.name, step.name);
    before = step.name;
  }
  return text;
}

}  // namespace

FarmFiles slurm_files(const FarmJob& job) {
  FarmFiles result;
  for (const FarmStep& step : job.steps) result.files.push_back({step.name + ".sbatch", step_script(job, step)});
  result.files.push_back({"submit.sh", submit_script(job)});
  result.start = "sh " + shell_quoted(job.folder + "/submit.sh");
  return result;
}

}  // namespace tyndall
