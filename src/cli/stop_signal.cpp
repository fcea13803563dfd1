#include "cli/stop_signal.h"

#include <unistd.h>

#include <csignal>
#include <cstring>

namespace tyndall::cli {
namespace {

// Signal handlers can reach nothing but globals.
std::atomic<bool> requested{false};
volatile std::sig_atomic_t signal_number = 0;
const char* volatile what_to_say = "";

void on_signal(int signal) {
  signal_number = signal;
  requested.store(true, std::memory_order_relaxed);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  const char* const text = what_to_say;
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

}  // namespace

void catch_stop_signals(const char* message) {
  what_to_say = message;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

const std::atomic<bool>& stop_requested() { return requested; }
int stop_exit_code() { return signal_number == 0 ? 0 : 128 + signal_number; }

}  // namespace tyndall::cli
