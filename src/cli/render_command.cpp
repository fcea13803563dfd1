#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "cli/checkpoint_file.h"
#include "cli/command.h"
#include "cli/denoiser.h"
#include "cli/error_log.h"
#include "cli/log.h"
#include "cli/memory.h"
#include "cli/notes.h"
#include "cli/output_paths.h"
#include "cli/print.h"
#include "cli/progress_display.h"
#include "cli/render_options.h"
#include "cli/room.h"
#include "cli/save.h"
#include "cli/stop_signal.h"
#include "cli/summary.h"
#include "tyndall/io.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

/// Before anything is built: whether what comes out of it can be written.
void check_outputs(const RenderOptions& options, const Scene& scene, const std::string& output) {
  check_writable(output);
  require_room(output, scene, options.keeps_checkpoints());
  if (!options.error_log.empty()) check_writable(options.error_log);
}

/// What the denoiser takes is not the render's.
std::size_t memory_for_render(const RenderOptions& options, const Scene& scene) {
  const std::size_t limit = memory_limit(options.max_memory);
  if (!options.denoise) return limit;
  return limit - std::min(limit, denoise_memory(pixels_of(scene)));
}

World build_for(const RenderOptions& options, Scene scene) {
  const RenderSettings& settings = scene.settings;
  const BuildSettings how{.lights = {settings.lights},
                          .volume_lights = settings.emission == EmissionStrategy::lights,
                          .sanitize = options.picture.sanitize,
                          .threads = settings.threads,
                          .max_memory = memory_for_render(options, scene)};
  return build(std::move(scene), how);
}

/// Files that accompany a render: they follow it, and it can go on from them.
struct Companions {
  CheckpointFile checkpoint;
  std::optional<ErrorLog> errors;
  std::optional<Denoiser> denoiser;
  std::string output;

  /// At 1, 2, 4 ... samples.
  void look_at(const RenderJob& job) {
    if (errors) errors->add(job);
    if (denoiser) denoiser->preview(job, output);
  }

  void resume(RenderJob& job, const RenderSettings& limits, bool quiet) {
    const bool found = checkpoint.resume(job, limits);
    if (found && errors) errors->resume(job.samples());
    if (quiet) return;
    if (found) log("{}: going on from {} samples a pixel\n", checkpoint.path(), job.samples());
    if (!found) log("{}: no such file; starting at the beginning\n", checkpoint.path());
  }
};

Rendering render_with(Companions& companions, const World& world, const RenderSettings& settings,
                      const RenderOptions& options) {
  catch_stop_signals("stopping soon; press again to quit at once and lose the image\n");
  ProgressDisplay display(options.quiet ? "none" : options.progress);
  RenderControl control{.progress = [&](const Progress& p) { display.show(p); }, .stop = &stop_requested()};
  const bool previews = companions.denoiser && companions.denoiser->previews();
  if (companions.errors || previews) control.checkpoint = [&](const RenderJob& job) { companions.look_at(job); };
  if (options.resume) control.begin = [&](RenderJob& job) { companions.resume(job, settings, options.quiet); };
  if (options.keeps_checkpoints()) control.save = [&](const RenderJob& job) { companions.checkpoint.save(job); };
  control.save_seconds = options.checkpoint.value_or(std::numeric_limits<double>::infinity());  // --resume alone: at a stop
  Rendering rendering = render(world, settings, control);
  display.finish();
  if (companions.errors) companions.errors->finish(rendering);
  return rendering;
}

/// A render that is complete needs its checkpoint no longer than until the image is safe, and the room it takes least of all.
void save_rendering(const Rendering& rendering, const std::string& output, const CheckpointFile& checkpoint,
                    bool keeps_checkpoints) {
  std::function<void()> remove_checkpoint;
  if (keeps_checkpoints && !rendering.report.stopped) remove_checkpoint = [&] { checkpoint.remove(); };
  save_image(rendering.image, output, remove_checkpoint);
  if (remove_checkpoint) remove_checkpoint();
}

/// What was rendered before need not be rendered again: an array of jobs can be submitted as often as you like.
bool is_there(const std::string& output, const World& world, const RenderSettings& settings) {
  std::error_code absent;
  if (!settings.slice || !std::filesystem::exists(output, absent)) return false;
  try {
    return holds_slice(read_image(output), world, settings);
  } catch (const Error&) {
    return false;  // damaged: it is rendered anew
  }
}

/// A slice says how it was made, so that the command for others can be told; one of a picture that is not all there is none.
void finish_slice(Rendering& rendering, const std::string& output, const std::string& command_line) {
  if (rendering.report.unrendered > 0)
    throw Error(Failure::incomplete, output + ": not written: the slice was stopped before every pixel had a sample");
  rendering.image.attributes["tyndall/command"] = command_line;
}

/// A render that was stopped at its first sample stays as it is.
std::optional<DenoiseReport> denoise_finished(const Denoiser& denoiser, Rendering& rendering, const std::string& output) {
  if (rendering.report.samples > 1) return denoiser.finish(rendering.image);
  log("{}: is not denoised: it has one sample a pixel, and noise is told from two\n", output);
  return std::nullopt;
}

int run_render(const RenderOptions& options, const std::string& command_line) {
  Timer watch;
  Summary summary;
  SceneFile file = read_scene(options.scene);
  apply(options, file.scene);
  std::optional<Denoiser> denoiser;
  if (options.denoise) denoiser.emplace(options, file.scene.settings);
  const RenderSettings settings = file.scene.settings;
  limit_image_threads(settings.threads);
  summary.output = output_path(options, file.scene);
  Companions companions{CheckpointFile(summary.output), {}, std::move(denoiser), summary.output};
  if (options.keeps_checkpoints()) companions.checkpoint.tidy();
  check_outputs(options, file.scene, summary.output);
  summary.read_seconds = watch.lap();

  std::optional<Reference> reference;
  if (!options.reference.empty()) reference = read_reference(options.reference);
  const World world = build_for(options, std::move(file.scene));
  summary.build = world.summary();
  summary.build_seconds = watch.lap();
  if (!options.quiet) log_text(notes_text(options.scene, file.warnings, summary.build));

  if (options.resume && is_there(summary.output, world, settings)) {
    if (!options.quiet) log("{}: this slice is there already; nothing to do\n", summary.output);
    return 0;
  }
  if (reference) reference->require_fit(world, settings, {settings.seed});
  if (reference) companions.errors.emplace(std::move(*reference), options.error_log);
  Rendering rendering = render_with(companions, world, settings, options);
  if (settings.slice) finish_slice(rendering, summary.output, command_line);
  summary.render = rendering.report;
  summary.width = rendering.image.width();
  summary.height = rendering.image.height();
  if (companions.denoiser) summary.denoised = denoise_finished(*companions.denoiser, rendering, summary.output);
  watch.lap();
  save_rendering(rendering, summary.output, companions.checkpoint, options.keeps_checkpoints());
  summary.write_seconds = watch.lap();

  if (!options.quiet) log_text(as_text(summary));
  if (companions.errors) companions.errors->require_written();
  if (options.json) print("{}\n", as_json(summary));
  return rendering.report.stopped ? stop_exit_code() : 0;
}

}  // namespace

void add_render(CLI::App& app, int& exit_code, const std::string& command_line) {
  auto* command = app.add_subcommand("render", "render a scene to an image");
  auto options = std::make_shared<RenderOptions>();
  declare(*command, *options);
  command->callback([options, command_line, &exit_code] { exit_code = run_render(*options, command_line); });
}

}  // namespace tyndall::cli
