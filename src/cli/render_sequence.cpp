#include "cli/render_sequence.h"

#include <optional>
#include <utility>

#include "cli/frame_list.h"
#include "cli/log.h"
#include "cli/notes.h"
#include "cli/picture_render.h"
#include "cli/print.h"
#include "cli/sequence_progress.h"
#include "cli/sequence_summary.h"
#include "cli/serve.h"
#include "cli/stop_signal.h"
#include "session/scene_hash.h"
#include "tyndall/frames.h"
#include "tyndall/io.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

/// What the command line and the film say, without what is rendered: all that a frame needs of a scene that was built before.
Scene outline_of(const Scene& scene) {
  Scene outline;
  outline.film = scene.film;
  outline.settings = scene.settings;
  outline.source = scene.source;
  return outline;
}

class Sequence {
 public:
  Sequence(const RenderOptions& options, const std::string& command_line)
      : options_(options),
        command_line_(command_line),
        frames_(frames_in(options.frames)),
        page_(serve(options)),
        progress_(options.quiet ? "none" : options.progress, frames_.size()) {}

  int run() {
    try {
      prepare();
    } catch (const std::exception& problem) {
      if (page_) page_->end(problem.what());
      throw;
    }
    try {
      render_frames();
    } catch (const std::exception& problem) {
      progress_.finish();
      finish(problem.what());
      throw;
    }
    progress_.finish();
    return finish();
  }

 private:
  void prepare() {
    SceneFile first = read(frames_.front());
    require_places(first.scene);
    for (const int frame : frames_) require_frame(first, options_.scene, frame);
    if (first.frame_names.empty()) outline_ = outline_of(first.scene);
    next_ = std::move(first);
  }

  void render_frames() {
    catch_stop_signals(kStopping);
    for (const int frame : frames_) {
      if (stop_requested()) break;
      progress_.begin(frame);
      try {
        render_frame(frame);
      } catch (const Error& error) {
        throw Error(error.failure(), error.what() + (" (frame " + std::to_string(frame) + ")"));
      }
    }
  }

  SceneFile read(int frame) {
    kept_.begin_scene();
    return read_scene(options_.scene, {.frame = frame, .kept = &kept_});
  }

  void require_places(const Scene& scene) {
    pattern_ = output_path(options_, scene);
    require_frame_place(pattern_, "-o");
    if (!options_.error_log.empty()) require_frame_place(options_.error_log, "--error-log");
    if (!options_.deep.empty()) require_frame_place(options_.deep, "--deep");
  }

  /// Noise is another one in each frame: that of one seed would stand still before what moves.
  RenderOptions options_of(int frame, const Scene& scene) const {
    RenderOptions options = options_;
    options.output = with_frame(pattern_, frame);
    options.reference = with_frame(options_.reference, frame);
    options.error_log = with_frame(options_.error_log, frame);
    options.deep = with_frame(options_.deep, frame);
    if (!options_.seed) options.seed = scene.settings.seed + static_cast<std::uint64_t>(frame);
    return options;
  }

  /// What is new for the frame: of a scene without a frame's number in it, after the first one the outline alone.
  SceneFile scene_of(int frame) {
    if (next_) return *std::exchange(next_, std::nullopt);
    if (outline_) return {*outline_, {}};
    return read(frame);
  }

  /// Nobody has built it yet.
  void put_back(SceneFile file) {
    file.scene.film = outline_->film;
    file.scene.settings = outline_->settings;
    next_ = std::move(file);
  }

  void render_frame(int frame) {
    Timer watch;
    const bool whole = next_ || !outline_;
    SceneFile file = scene_of(frame);
    const RenderOptions options = options_of(frame, file.scene);
    PictureRender picture(options, file.scene, page_.get());
    if (page_) page_->begin("building", picture.output());
    if (options_.resume && picture.is_finished(hashes_of(file.scene, whole))) {
      if (whole && outline_) put_back(std::move(file));
      return skip(frame, picture);
    }
    Summary times;
    times.read_seconds = watch.lap();
    if (whole) build(picture, std::move(file));
    times.build_seconds = watch.lap();
    if (picture.is_slice_there(*world_)) return skip(frame, picture);
    if (stop_requested()) return;  // what stands there stays
    std::optional<Summary> summary = picture.run(*world_, command_line_, [&](const Progress& p) { progress_.show(p); });
    if (!summary) return;
    summary->read_seconds = times.read_seconds;
    summary->build_seconds = times.build_seconds;
    summary->build = world_->summary();
    picture.require_log_written();
    stopped_ = stopped_ || summary->render.stopped;
    if (!outline_) world_.reset();  // before the next one takes its room
    summary_.frames.push_back({frame, std::move(*summary)});
  }

  const SceneHashes& hashes_of(const Scene& scene, bool whole) {
    if (whole) hashes_ = {hash_scene(scene, &kept_), hash_names(scene)};
    return hashes_;
  }

  void build(const PictureRender& picture, SceneFile file) {
    world_.reset();
    world_.emplace(picture.build(std::move(file.scene), &kept_));
    ++summary_.builds;
    if (!options_.quiet && summary_.builds == 1) log_text(notes_text(options_.scene, file.warnings, world_->summary()));
  }

  void skip(int frame, const PictureRender& picture) {
    summary_.there.push_back(frame);
    progress_.skip();
    if (!options_.quiet) log("{}: is there already\n", picture.output());
  }

  /// `problem`: what ended the sequence before its last frame.
  int finish(const std::string& problem = {}) {
    summary_.output = pattern_;
    summary_.asked = frames_.size();
    summary_.files_read = kept_.made();
    summary_.files_kept = kept_.reused();
    if (!options_.quiet) log_text(as_text(summary_));
    if (options_.json) print("{}\n", as_json(summary_));
    if (page_) page_->end(problem.empty() ? outcome_text(summary_) : outcome_text(summary_) + "; " + problem);
    return stopped_ || summary_.missing() > 0 ? stop_exit_code() : 0;
  }

  const RenderOptions& options_;
  const std::string& command_line_;
  std::vector<int> frames_;
  std::unique_ptr<LivePage> page_;  ///< null: not asked for
  std::string pattern_;             ///< of the output
  KeptFiles kept_;
  std::optional<SceneFile> next_;  ///< read, and not built yet
  std::optional<Scene> outline_;   ///< of a scene that all frames share
  std::optional<World> world_;
  SceneHashes hashes_;
  SequenceProgress progress_;
  SequenceSummary summary_;
  bool stopped_ = false;
};

}  // namespace

int render_sequence(const RenderOptions& options, const std::string& command_line) {
  return Sequence(options, command_line).run();
}

}  // namespace tyndall::cli
