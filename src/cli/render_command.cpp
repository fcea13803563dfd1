#include <filesystem>

#include "cli/command.h"
#include "cli/error_log.h"
#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/print.h"
#include "cli/progress_display.h"
#include "cli/render_options.h"
#include "cli/stop_signal.h"
#include "cli/stopwatch.h"
#include "cli/summary.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

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
  if (!options.error_log.empty()) check_writable(options.error_log);
  summary.read_seconds = watch.lap();

  std::optional<Reference> reference;
  if (!options.reference.empty()) reference = read_reference(options.reference);
  const World world = build(std::move(file.scene),
                            {.lights = {settings.lights}, .sanitize = options.picture.sanitize, .threads = settings.threads});
  summary.build = world.summary();
  summary.build_seconds = watch.lap();
  if (!options.quiet) print_notes(file, world);

  if (reference) reference->require_fit(world, settings, {settings.seed});
  std::optional<ErrorLog> errors;
  if (reference) errors.emplace(std::move(*reference), options.error_log);
  catch_stop_signals("stopping after this pass; press again to quit at once and lose the image\n");
  ProgressDisplay display(options.quiet ? "none" : options.progress);
  RenderControl control{.progress = [&](const Progress& p) { display.show(p); }, .stop = &stop_requested()};
  if (errors) control.checkpoint = [&](const RenderJob& job) { errors->add(job); };
  const Rendering rendering = render(world, settings, control);
  display.finish();
  if (errors) errors->finish(rendering);
  summary.render = rendering.report;
  summary.width = rendering.image.width();
  summary.height = rendering.image.height();
  watch.lap();
  write_image(rendering.image, summary.output);
  summary.write_seconds = watch.lap();

  if (!options.quiet) log_text(as_text(summary));
  if (errors) errors->require_written();
  if (options.json) print("{}\n", as_json(summary));
  return rendering.report.stopped ? stop_exit_code() : 0;
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("render", "render a scene to an image");
  auto options = std::make_shared<RenderOptions>();
  declare(*command, *options);
  command->callback([options, &exit_code] { exit_code = run_render(*options); });
}

}  // namespace tyndall::cli
