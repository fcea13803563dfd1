/// How many samples come next, and how long it will take.
#pragma once

#include <chrono>
#include <optional>

#include "tyndall/render.h"

namespace tyndall {

/// Splits a render into passes over the whole picture. Passes grow with what is done, so that the first picture is
/// there at once and the bookkeeping is soon negligible, but stay short enough for a stop to be prompt. How samples
/// are grouped does not change the picture.
class PassSchedule {
 public:
  explicit PassSchedule(const RenderSettings& settings) : settings_(settings) {}

  /// Samples a pixel in the next pass; 0 when the render is complete.
  int next_pass() const;
  void finish_pass(int count) { samples_done_ += count; }

  int samples_done() const { return samples_done_; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Where the render stands when the running pass has done `pass_samples` samples a pixel; nothing when the last
  /// report is too fresh.
  std::optional<Progress> progress(double pass_samples);

 private:
  using Clock = std::chrono::steady_clock;
  RenderSettings settings_;
  Clock::time_point start_ = Clock::now();
  int samples_done_ = 0;
  double last_report_ = -1;
};

}  // namespace tyndall
