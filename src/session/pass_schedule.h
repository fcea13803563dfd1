/// How many samples come next, and how long it will take.
#pragma once

#include <optional>

#include "session/resolved_settings.h"
#include "tyndall/render.h"
#include "tyndall/timer.h"

namespace tyndall {

/// Splits a render into passes over the whole picture. Passes grow with what is done, so that the first picture is
/// there at once and the bookkeeping is soon negligible, but stay short enough for a stop to be prompt. How samples
/// are grouped does not change the picture.
class PassSchedule {
 public:
  /// `checkpoints`: passes end at every power of two.
  PassSchedule(const RenderSettings& settings, bool checkpoints)
      : settings_(settings),
        samples_wanted_(sample_range(settings).count),
        checkpoints_(checkpoints),
        adaptive_(is_adaptive(settings)),
        until_error_(has_error_goal(settings)) {}

  static bool is_checkpoint(int samples) { return samples > 0 && (samples & (samples - 1)) == 0; }

  /// Samples a pixel in the next pass, which begins now; 0 when the render is complete.
  int next_pass(const RenderJob& job);
  /// One of the settings' ends is reached.
  bool complete(const RenderJob& job) const;

  /// Where the render stands when the running pass has done `pass_samples` samples a pixel, 0 when it has ended; nothing
  /// before the first pass, or when the last report is too fresh.
  std::optional<Progress> progress(const RenderJob& job, double pass_samples);

 private:
  bool is_error_check(int samples) const;
  bool is_time_up(const RenderJob& job) const;
  double excess(const RenderReport& report) const;
  bool is_good_enough(const RenderReport& report) const;
  double share(double samples) const;
  double fraction(double samples, double seconds) const;
  double remaining(double samples, double seconds, double working) const;

  /// The job as a pass found it: the first one empty, or resumed.
  struct Begun {
    Timer timer;
    int samples;
    double seconds, preparing;
  };

  RenderSettings settings_;
  int samples_wanted_;
  std::optional<Begun> begun_, pass_;  ///< all, and the latest pass
  bool checkpoints_, adaptive_, until_error_;
  double samples_needed_ = 0;  ///< for the errors of the settings, as far as is known; 0: not known
  double last_report_ = -1;
};

}  // namespace tyndall
