/// The error of a running render against a reference, line by line.
#pragma once

#include <string>

#include "report/reference.h"

namespace tyndall::cli {

/// A file of JSON lines {"seconds", "samples", "mse", "relmse", "relmse_trimmed", "mape", "smape"}: compare's
/// checkpoints. Written anew, safely, with every line.
class ErrorLog {
 public:
  /// Throws Error: scene when the reference cannot be read, usage when it has other pixels than the render.
  ErrorLog(const std::string& reference, const std::string& path, const PixelBounds& pixels);

  void add(const RenderJob& job) { add(job.seconds(), job.samples(), job.image()); }
  /// The end of a render, unless add() has seen it.
  void finish(const Rendering& rendering);

 private:
  void add(double seconds, int samples, const Image& image);

  Reference reference_;
  std::string path_, lines_;
  int last_samples_ = 0;
};

}  // namespace tyndall::cli
