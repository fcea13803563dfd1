#include <algorithm>
#include <filesystem>

#include "cli/command.h"
#include "cli/folder_check.h"
#include "cli/frame_list.h"
#include "cli/notes.h"
#include "cli/print.h"
#include "tyndall/frames.h"

namespace tyndall::cli {
namespace {

/// Problems of one scene, printed one a line.
void print_verdict(const Verdict& verdict) {
  print_text(notes_text(verdict.path, verdict.warnings, verdict.build));
  for (const std::string& error : verdict.errors) print("{}\n", error);
  if (verdict.ok()) print("{}: ok\n", verdict.name());
}

/// The scene, or each of its frames; where these are all the same, the first.
std::vector<Verdict> verdicts_on(const std::string& path, const std::vector<int>& frames) {
  if (frames.empty()) return {verdict_on(path)};
  KeptFiles kept;
  std::vector<Verdict> verdicts;
  for (const int frame : frames) {
    kept.begin_scene();
    verdicts.push_back(verdict_on(path, {.frame = frame, .kept = &kept}));
    if (verdicts.front().ok() && !verdicts.front().by_frame) break;
  }
  return verdicts;
}

int run_check(const std::vector<std::string>& paths, const std::string& frame_list, bool json) {
  const std::vector<int> frames = frame_list.empty() ? std::vector<int>() : frames_in(frame_list);
  std::vector<std::string> in_folders;
  std::vector<Verdict> verdicts;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
      if (!frames.empty()) throw Error(Failure::usage, "--frames are a scene's, and " + path + " is a folder; name the scene");
      const std::vector<std::string> scenes = scenes_below(path);
      in_folders.insert(in_folders.end(), scenes.begin(), scenes.end());
    } else {
      for (Verdict& verdict : verdicts_on(path, frames)) {
        if (!json) print_verdict(verdict);
        verdicts.push_back(std::move(verdict));
      }
    }
  }
  const std::vector<Verdict> table = check_all(in_folders, !json);
  verdicts.insert(verdicts.end(), table.begin(), table.end());
  if (json) print_json(verdicts);
  const bool ok = std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.ok(); });
  return ok ? 0 : static_cast<int>(Failure::scene);
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("check", "read and build scenes, list every problem, render nothing");
  command->footer(
      "Of a folder: a table of all the scenes below it, .pbrt and .pbrt.gz that have a WorldBegin. Exit code 3: not all are "
      "ok.\n"
      "Example: tyndall check scenes");
  auto paths = std::make_shared<std::vector<std::string>>();
  auto json = std::make_shared<bool>(false);
  auto frames = std::make_shared<std::string>();
  command->add_option("scenes", *paths, "scene files, and folders of them")->required();
  declare_frames(*command, *frames);
  command->add_flag("--json", *json, "as JSON on stdout");
  command->callback([paths, frames, json, &exit_code] { exit_code = run_check(*paths, *frames, *json); });
}

}  // namespace tyndall::cli
