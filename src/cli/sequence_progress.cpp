#include "cli/sequence_progress.h"

#include <fmt/core.h>

namespace tyndall::cli {

void SequenceProgress::begin(int frame) {
  if (begun_ > skipped_) rendered_seconds_ += frame_.seconds();
  ++begun_;
  frame_ = {};
  display_.go_on_with(fmt::format("frame {} ({} of {})", frame, begun_, frames_));
}

void SequenceProgress::skip() {
  ++skipped_;
  display_.finish();
}

/// Frames to come take as long as those that were rendered did on average, reading and building included.
void SequenceProgress::show(const Progress& p) {
  const double this_frame = frame_.seconds() + p.remaining;
  const auto rendered = static_cast<double>(begun_ - skipped_);  // with this one
  const double mean = (rendered_seconds_ + this_frame) / rendered;
  Progress whole = p;
  whole.fraction = (static_cast<double>(begun_ - 1) + p.fraction) / static_cast<double>(frames_);
  whole.seconds = all_.seconds();
  whole.remaining = p.remaining + mean * static_cast<double>(frames_ - begun_);
  display_.show(whole);
}

}  // namespace tyndall::cli
