/// Many pictures as one progress.
#pragma once

#include <cstddef>
#include <string>

#include "cli/progress_display.h"
#include "tyndall/timer.h"

namespace tyndall::cli {

class SequenceProgress {
 public:
  /// `kind` as of ProgressDisplay.
  SequenceProgress(const std::string& kind, std::size_t frames) : display_(kind), frames_(frames) {}

  void begin(int frame);                ///< the one before, if any, has ended
  void skip();                          ///< the frame that has begun takes no time; the line is free for a message
  void show(const Progress& progress);  ///< of the frame that has begun
  void finish() { display_.finish(); }

 private:
  ProgressDisplay display_;
  std::size_t frames_, begun_ = 0, skipped_ = 0;
  Timer all_, frame_;
  double rendered_seconds_ = 0;  ///< of the frames that have ended
};

}  // namespace tyndall::cli
