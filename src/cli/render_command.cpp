#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>

#include "cli/command.h"
#include "cli/log.h"
#include "cli/progress_display.h"
#include "cli/render_options.h"
#include "cli/summary.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

// Signal handlers can reach nothing but globals.
std::atomic<bool> stop_requested{false};
volatile std::sig_atomic_t stop_signal = 0;

constexpr char kStopping[] = "stopping after this pass; press again to quit at once and lose the image\n";

/// First signal: end at the next pass with what there is. Second, of either kind: end at once.
void on_signal(int signal) {
  stop_signal = signal;
  stop_requested.store(true, std::memory_order_relaxed);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (write(STDERR_FILENO, kStopping, sizeof kStopping - 1) < 0) return;
}

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Found out before the work, not after it.
void check_writable(const std::string& path) {
  namespace fs = std::filesystem;
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw Error(Failure::output, path + ": is a folder; give a file name with -o");
  }
  if (!fs::is_directory(folder, ignored)) {
    throw Error(Failure::output, path + ": folder " + folder.string() + " does not exist; make it first");
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw Error(Failure::output, path + ": folder " + folder.string() + " is not writable; choose another with -o");
  }
}

void write_image(const Image& image, const std::string& path) {
  if (std::filesystem::path(path).extension() == ".png") {
    write_png(image, path);
  } else {
    write_exr(image, path);
  }
}

void print_notes(const SceneFile& file, const World& world) {
  for (const Warning& w : file.warnings) {
    log("warning: {}{}{}\n", w.where.str(), w.where.file.empty() ? "" : ": ", w.message);
  }
  for (const std::string& note : world.summary().notes) log("note: {}\n", note);
}

int run_render(const RenderOptions& options) {
  Stopwatch watch;
  Summary summary;
  SceneFile file = read_scene(options.scene);
  apply(options, file.scene);
  const RenderSettings settings = file.scene.settings;
  summary.output = output_path(options, file.scene);
  check_writable(summary.output);
  summary.read_seconds = watch.lap();

  const World world = build(std::move(file.scene),
                            {.lights = {settings.lights}, .sanitize = options.sanitize, .threads = settings.threads});
  summary.build = world.summary();
  summary.build_seconds = watch.lap();
  if (!options.quiet) print_notes(file, world);

  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  ProgressDisplay display(options.quiet ? "none" : options.progress);
  const Rendering rendering =
      render(world, settings, {.progress = [&](const Progress& p) { display.show(p); }, .stop = &stop_requested});
  display.finish();
  summary.render = rendering.report;
  summary.width = rendering.image.width();
  summary.height = rendering.image.height();
  watch.lap();
  write_image(rendering.image, summary.output);
  summary.write_seconds = watch.lap();

  if (!options.quiet) log_text(as_text(summary));
  if (options.json) fmt::print("{}\n", as_json(summary));
  return rendering.report.stopped ? 128 + stop_signal : 0;
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("render", "render a scene to an image");
  auto options = std::make_shared<RenderOptions>();
  declare(*command, *options);
  command->callback([options, &exit_code] { exit_code = run_render(*options); });
}

}  // namespace tyndall::cli
