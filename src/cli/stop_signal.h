/// Ctrl-C and SIGTERM as a request to end soon and keep what there is.
#pragma once

#include <atomic>

namespace tyndall::cli {

/// From now on the first signal sets stop_requested() and prints `message`; the second ends the program at once.
/// `message` must live as long as the program.
void catch_stop_signals(const char* message);
/// What the first Ctrl-C does, with a message of its own; after one, nothing. Where signals are not caught yet, it ends the
/// program at once. From any thread.
void request_stop(const char* message);
const std::atomic<bool>& stop_requested();
/// 128 + the signal: the exit code of a program that it ended; 0 when there was none.
int stop_exit_code();
/// What a render says then.
inline constexpr const char* kStopping = "stopping soon; press again to quit at once and lose the image\n";

}  // namespace tyndall::cli
