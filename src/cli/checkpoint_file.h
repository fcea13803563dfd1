/// The file beside the output that a render which was cut off goes on from.
#pragma once

#include <string>

#include "tyndall/render.h"

namespace tyndall::cli {

/// OUT.exr.checkpoint. Always a whole one: the last that was written safely.
class CheckpointFile {
 public:
  explicit CheckpointFile(const std::string& output) : output_(output), path_(output + ".checkpoint") {}

  const std::string& path() const { return path_; }
  /// Takes up what the file holds; false when there is none. Throws Error (scene) when it is damaged or of another scene,
  /// other options or another build, or holds more samples or seconds than `limits` allow.
  bool resume(RenderJob& job, const RenderSettings& limits) const;
  /// A failure is told on stderr, once for each reason, and costs no render.
  void save(const RenderJob& job);
  void remove() const;
  /// Removes what killed processes left of writing it and the output.
  void tidy() const;

 private:
  std::string output_, path_, failure_;
};

}  // namespace tyndall::cli
