#include <algorithm>
#include <filesystem>

#include "cli/checkpoint_file.h"
#include "cli/command.h"
#include "cli/error_log.h"
#include "cli/log.h"
#include "cli/memory.h"
#include "cli/output_paths.h"
#include "cli/print.h"
#include "cli/progress_display.h"
#include "cli/render_options.h"
#include "cli/save_image.h"
#include "cli/stop_signal.h"
#include "cli/stopwatch.h"
#include "cli/summary.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

void print_notes(const SceneFile& file, const World& world) {
  for (const Warning& w : file.warnings) {
    log("warning: {}{}{}\n", w.where.str(), w.where.file.empty() ? "" : ": ", w.message);
  }
  for (const std::string& note : world.summary().notes) log("note: {}\n", note);
}

/// Upper bound of the file's size: what it would take without compression.
std::uint64_t largest_file(const Scene& scene, const std::string& path) {
  const PixelBounds& crop = scene.settings.crop.value_or(scene.film.crop);
  const std::uint64_t pixels = static_cast<std::uint64_t>(std::max(crop.width(), 0)) * static_cast<std::uint64_t>(std::max(crop.height(), 0));
  constexpr std::uint64_t kHeader = 1 << 16;
  if (std::filesystem::path(path).extension() == ".png") return 3 * pixels + kHeader;
  return sizeof(float) * (4 + 4 * scene.settings.aovs.size()) * pixels + kHeader;
}

/// Hooks of a render that keeps checkpoints, or takes one up.
void keep_checkpoints(const RenderOptions& options, CheckpointFile& file, RenderControl& control) {
  if (options.resume) {
    control.begin = [&](RenderJob& job) {
      const bool found = file.resume(job);
      if (options.quiet) return;
      if (found) log("{}: going on from {} samples a pixel\n", file.path(), job.samples());
      if (!found) log("{}: no such file; starting at the beginning\n", file.path());
    };
  }
  if (!options.checkpoint) return;
  control.save = [&](const RenderJob& job) { file.save(job); };
  control.save_seconds = *options.checkpoint;
}

int run_render(const RenderOptions& options) {
  Stopwatch watch;
  Summary summary;
  SceneFile file = read_scene(options.scene);
  apply(options, file.scene);
  const RenderSettings settings = file.scene.settings;
  summary.output = output_path(options, file.scene);
  check_writable(summary.output);
  check_room(summary.output, largest_file(file.scene, summary.output));
  if (!options.error_log.empty()) check_writable(options.error_log);
  summary.read_seconds = watch.lap();

  std::optional<Reference> reference;
  if (!options.reference.empty()) reference = read_reference(options.reference);
  const World world = build(std::move(file.scene), {.lights = {settings.lights},
                                                    .fire = settings.emission == EmissionStrategy::lights,
                                                    .sanitize = options.picture.sanitize,
                                                    .threads = settings.threads,
                                                    .max_memory = memory_limit(options.max_memory)});
  summary.build = world.summary();
  summary.build_seconds = watch.lap();
  if (!options.quiet) print_notes(file, world);

  if (reference) reference->require_fit(world, settings, {settings.seed});
  std::optional<ErrorLog> errors;
  if (reference) errors.emplace(std::move(*reference), options.error_log);
  CheckpointFile checkpoint(summary.output);
  catch_stop_signals("stopping soon; press again to quit at once and lose the image\n");
  ProgressDisplay display(options.quiet ? "none" : options.progress);
  RenderControl control{.progress = [&](const Progress& p) { display.show(p); }, .stop = &stop_requested()};
  if (errors) control.checkpoint = [&](const RenderJob& job) { errors->add(job); };
  keep_checkpoints(options, checkpoint, control);
  const Rendering rendering = render(world, settings, control);
  display.finish();
  if (errors) errors->finish(rendering);
  summary.render = rendering.report;
  summary.width = rendering.image.width();
  summary.height = rendering.image.height();
  watch.lap();
  save_image(rendering.image, summary.output);
  if (!rendering.report.stopped && (options.checkpoint || options.resume)) checkpoint.remove();
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
