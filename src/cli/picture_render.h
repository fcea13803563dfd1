/// One picture, from a scene that was read to a file that is safe: what `render` does once, and for each of --frames.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/checkpoint_file.h"
#include "cli/denoiser.h"
#include "cli/error_log.h"
#include "cli/page_feed.h"
#include "cli/render_options.h"
#include "cli/summary.h"
#include "cli/viewer_link.h"
#include "tyndall/render.h"

namespace tyndall::cli {

/// What makes a scene another one.
struct SceneHashes {
  std::uint64_t scene = 0, names = 0;  ///< hash_scene, hash_names
};

class PictureRender {
 public:
  /// Applies `options` to `scene`, and looks whether what comes out can be written. `options` must outlive this. Throws Error.
  /// `page`: shows the render as it goes; null: there is none.
  PictureRender(const RenderOptions& options, Scene& scene, LivePage* page = nullptr);

  const std::string& output() const { return output_; }
  /// Whether the output is this picture already, complete, of a scene with this hash_scene(). Not for slices.
  bool is_finished(const SceneHashes& of) const;

  /// The scene as the constructor left it. `kept` may be null.
  World build(Scene scene, KeptFiles* kept) const;
  /// Whether the output is the slice that was asked for.
  bool is_slice_there(const World& world) const;

  /// Renders, denoises and writes; with the summary's parts for these. An interrupt ends it early; before any pixel has a
  /// sample nothing is written, and there is no summary.
  std::optional<Summary> run(const World& world, const std::string& command_line,
                             const std::function<void(const Progress&)>& progress);
  /// Throws the Error (output) with which the last writing of --error-log failed: to be called when the image is safe.
  void require_log_written() const;

 private:
  Rendering render_with(const World& world, const std::function<void(const Progress&)>& progress);
  void resume(RenderJob& job);
  void look_at(const RenderJob& job);
  void finish_slice(Rendering& rendering, const std::string& command_line) const;
  std::optional<DenoiseReport> denoise_finished(Rendering& rendering) const;
  void save(const Rendering& rendering) const;
  bool holds_all_channels(const Image& header) const;
  bool holds_names(const Image& header, std::uint64_t names) const;
  bool holds_deep(const Image& header) const;

  const RenderOptions& options_;
  std::vector<std::string> asked_aovs_;
  std::optional<Denoiser> denoiser_;
  RenderSettings settings_;
  std::string output_;
  PixelBounds pixels_;
  std::size_t memory_;  ///< bytes, for the render
  CheckpointFile checkpoint_;
  std::optional<Reference> reference_;
  std::optional<ErrorLog> errors_;
  std::unique_ptr<ViewerLink> viewer_;  ///< null: not asked for
  std::optional<PageFeed> page_;
};

}  // namespace tyndall::cli
