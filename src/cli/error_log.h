/// The error of a running render against a reference, line by line.
#pragma once

#include <string>

#include "report/reference.h"

namespace tyndall::cli {

/// A file of JSON lines {"seconds", "samples", "mse", "relmse", "relmse_trimmed", "mape", "smape"}: compare's
/// checkpoints. Written anew, safely, with every line; when that fails the render goes on.
class ErrorLog {
 public:
  ErrorLog(Reference reference, const std::string& path) : reference_(std::move(reference)), path_(path) {}

  /// Of a render that goes on from `samples` a pixel: the lines of the file up to there stay.
  void resume(int samples);
  void add(const RenderJob& job) { add(job.seconds(), job.samples(), job.image()); }
  /// The end of a render, unless add() has seen it.
  void finish(const Rendering& rendering);
  /// Throws the Error (output) with which the last writing failed, if it did: to be called when the image is safe.
  void require_written() const;

 private:
  void add(double seconds, int samples, const Image& image);

  Reference reference_;
  std::string path_, lines_, failure_;
  int last_samples_ = 0;
};

}  // namespace tyndall::cli
