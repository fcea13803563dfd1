#include <fmt/core.h>

#include <algorithm>

#include "cli/command.h"
#include "cli/duration.h"
#include "cli/log.h"
#include "cli/print.h"
#include "cli/validators.h"
#include "report/merge.h"
#include "report/slice_status.h"
#include "tyndall/error.h"

namespace tyndall::cli {
namespace {

struct StatusOptions {
  std::string folder;
  double lost_after = 300;
  bool error = false;
};

std::string name_of(SliceState state) {
  switch (state) {
    case SliceState::there:
      return "there";
    case SliceState::running:
      return "running";
    case SliceState::lost:
      return "lost";
    case SliceState::missing:
      break;
  }
  return "missing";
}

void print_slice(const FolderStatus& status, std::size_t i) {
  const SliceStatus& slice = status.slices[i];
  const std::string samples =
      status.timed ? std::to_string(slice.samples) : fmt::format("{} of {}", slice.samples, slice.share);
  print("  {:>5}  {:<8} {:>16}  {:>12}  {:>14}\n", i + 1, name_of(slice.state), samples,
        slice.seconds > 0 ? duration(slice.seconds) : "",
        slice.state == SliceState::missing ? "" : duration(slice.age) + " ago");
}

void print_sum(const FolderStatus& status) {
  const auto count = [&](SliceState state) {
    return std::count_if(status.slices.begin(), status.slices.end(), [&](const SliceStatus& s) { return s.state == state; });
  };
  long long samples = 0;
  double longest = 0, all = 0;
  for (const SliceStatus& slice : status.slices) {
    if (slice.state == SliceState::there) samples += slice.samples;
    const double left = seconds_left(status, slice);
    all += left;
    if (slice.state == SliceState::running) longest = std::max(longest, left);
  }
  print("there {}, running {}, lost {}, missing {}; {} samples a pixel can be merged\n", count(SliceState::there),
        count(SliceState::running), count(SliceState::lost), count(SliceState::missing), samples);
  if (longest > 0) print("what runs takes about {} more\n", duration(longest));
  if (all > longest) print("{} of rendering are left in all\n", duration(all));
}

void print_error(const FolderStatus& status) {
  std::vector<std::string> paths;
  for (const SliceStatus& slice : status.slices) {
    if (slice.state == SliceState::there) paths.push_back(slice.path);
  }
  if (paths.empty()) return;
  const Merged merged = merge_slices(paths);
  if (merged.relmse) print("estimated relMSE of what is there: {:.3g}\n", *merged.relmse);
}

int run_status(const StatusOptions& options) {
  const FolderStatus status = folder_status(options.folder, options.lost_after);
  for (const std::string& why : status.unreadable) log("tyndall: {}\n", why);
  print("  slice  state             samples     rendering       last heard\n");
  for (std::size_t i = 0; i < status.slices.size(); ++i) print_slice(status, i);
  print_sum(status);
  if (options.error) print_error(status);
  const bool all = std::all_of(status.slices.begin(), status.slices.end(),
                               [](const SliceStatus& s) { return s.state == SliceState::there; });
  return all ? 0 : static_cast<int>(Failure::incomplete);
}

}  // namespace

void add_status(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("status", "how far the slices of a render in a folder have come");
  command->footer(
      "Read from images and checkpoints alone: render --slice I/N --checkpoint 60 -o FOLDER/slice-I.exr. Exit code 7: some "
      "slices\n"
      "are not there yet.\n"
      "Example: tyndall status slices");
  auto options = std::make_shared<StatusOptions>();
  command->add_option("folder", options->folder, "where the slices are written")->required();
  command
      ->add_option("--lost-after", options->lost_after,
                   "seconds without a new checkpoint after which a slice counts as lost [300]; --lost-after 900")
      ->check(positive());
  command->add_flag("--error", options->error, "add up the slices that are there, for their estimated relMSE");
  command->callback([options, &exit_code] { exit_code = run_status(*options); });
}

}  // namespace tyndall::cli
