#include "cli/command.h"
#include "cli/log.h"
#include "cli/notes.h"
#include "cli/picture_render.h"
#include "cli/print.h"
#include "cli/progress_display.h"
#include "cli/render_options.h"
#include "cli/render_sequence.h"
#include "cli/serve.h"
#include "cli/stop_signal.h"
#include "tyndall/io.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

int render_picture(const RenderOptions& options, const std::string& command_line, LivePage* page) {
  Timer watch;
  SceneFile file = read_scene(options.scene);
  PictureRender picture(options, file.scene, page);
  const double read_seconds = watch.lap();
  const World world = picture.build(std::move(file.scene), nullptr);
  const double build_seconds = watch.lap();
  if (!options.quiet) log_text(notes_text(options.scene, file.warnings, world.summary()));
  if (picture.is_slice_there(world)) {
    if (!options.quiet) log("{}: this slice is there already; nothing to do\n", picture.output());
    if (page) page->end(picture.output() + " is there already");
    return 0;
  }

  catch_stop_signals(kStopping);
  ProgressDisplay display(options.quiet ? "none" : options.progress, options.denoise ? "denoising" : "");
  std::optional<Summary> done = picture.run(world, command_line, [&](const Progress& p) { display.show(p); });
  display.finish();
  if (!done) {
    if (page) page->end(picture.output() + ": stopped before any pixel had a sample");
    return stop_exit_code();
  }
  Summary& summary = *done;
  summary.read_seconds = read_seconds;
  summary.build_seconds = build_seconds;
  summary.build = world.summary();
  if (!options.quiet) log_text(as_text(summary));
  picture.require_log_written();
  if (options.json) print("{}\n", as_json(summary));
  const int exit_code = summary.render.stopped ? stop_exit_code() : 0;
  if (page) page->end(outcome_text(summary));
  return exit_code;
}

int run_render(const RenderOptions& options, const std::string& command_line) {
  const std::unique_ptr<LivePage> page = serve(options);
  try {
    return render_picture(options, command_line, page.get());
  } catch (const std::exception& e) {
    if (page) page->end(e.what());
    throw;
  }
}

}  // namespace

void add_render(CLI::App& app, int& exit_code, const std::string& command_line) {
  auto* command = app.add_subcommand("render", "render a scene to an image, or a sequence to one for each frame");
  auto options = std::make_shared<RenderOptions>();
  declare(*command, *options);
  command->callback([options, command_line, &exit_code] {
    exit_code = options->frames.empty() ? run_render(*options, command_line) : render_sequence(*options, command_line);
  });
}

}  // namespace tyndall::cli
