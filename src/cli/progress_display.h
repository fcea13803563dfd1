/// Shows how far a render is, on stderr.
#pragma once

#include <string>

#include "tyndall/render.h"

namespace tyndall::cli {

/// kind: "bar" redraws one line, "line" prints a line every few seconds, "json" one object a report, "none" nothing;
/// "auto" is bar on a terminal and line elsewhere.
class ProgressDisplay {
 public:
  /// `next`: what comes after what is shown, and is not in the time that is left; empty: nothing.
  explicit ProgressDisplay(const std::string& kind, const std::string& next = {});
  ~ProgressDisplay() { finish(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// What the next reports are about; each activity starts a clock of its own. Empty: the only one.
  void begin(const std::string& activity);
  /// The same, while clock and bar go on.
  void go_on_with(const std::string& activity) { activity_ = activity + ": "; }
  void show(const Progress& progress);
  void finish();  ///< leaves the cursor on a fresh line

 private:
  std::string kind_, next_, activity_;
  double last_line_ = 0;
  bool drawn_ = false;
};

}  // namespace tyndall::cli
