#include "cli/command.h"
#include "cli/memory.h"
#include "cli/notes.h"
#include "cli/print.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

namespace tyndall::cli {
namespace {

/// Problems of one scene, printed one a line; returns how many.
std::size_t check_file(const std::string& path) {
  SceneCheck check = check_scene(path);
  print_text(notes_text(path, check.warnings, {}));
  for (const std::string& error : check.errors) print("{}\n", error);
  if (!check.errors.empty()) return check.errors.size();
  try {
    const World world = build(std::move(check.scene), {.max_memory = memory_limit({})});
    print_text(notes_text(path, {}, world.summary()));
  } catch (const Error& e) {
    print("{}\n", e.what());
    return 1;
  }
  print("{}: ok\n", path);
  return 0;
}

int run_check(const std::vector<std::string>& scenes) {
  std::size_t problems = 0;
  for (const std::string& scene : scenes) {
    try {
      problems += check_file(scene);
    } catch (const Error& e) {
      print("{}\n", e.what());
      ++problems;
    }
  }
  return problems > 0 ? static_cast<int>(Failure::scene) : 0;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("check", "read and build scenes, list every problem, render nothing");
  auto scenes = std::make_shared<std::vector<std::string>>();
  command->add_option("scenes", *scenes, "scene files")->required();
  command->callback([scenes, &exit_code] { exit_code = run_check(*scenes); });
}

}  // namespace tyndall::cli
