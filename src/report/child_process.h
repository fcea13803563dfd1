/// Programs run beside this one: what they do, a crash or a hang included, does not reach it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tyndall {

struct ChildCommand {
  std::vector<std::string> arguments;  ///< the program first, by path
  std::string folder;                  ///< where it runs
  std::string out, log;                ///< files that take its stdout and stderr
  double timeout = 60;                 ///< seconds, then it is killed
};

struct ChildResult {
  enum class End { exited, signalled, timed_out, skipped } end = End::skipped;
  int code = 0;        ///< exit code, or the number of the signal
  double seconds = 0;  ///< it ran
};

/// How a list of children is run. Callbacks come one at a time, from the calling thread.
struct ChildControl {
  int at_once = 1;                                            ///< children side by side, >= 1
  std::function<bool(std::size_t)> skip;                      ///< asked before child i starts; may be empty
  std::function<void(std::size_t, const ChildResult&)> done;  ///< child i has ended or was skipped
  const std::atomic<bool>* stop = nullptr;                    ///< set it to kill what runs and skip the rest
};

/// Runs them all, in order of start. Throws Error (run_time) when no process can be made, and what a callback throws; no
/// child is left then, nor when this process is killed.
void run_children(const std::vector<ChildCommand>& commands, const ChildControl& control);

/// "segmentation fault", "killed by signal 31".
std::string describe_signal(int signal);

}  // namespace tyndall
