#include "cli/stop_signal.h"

#include <unistd.h>

#include <csignal>
#include <cstring>

namespace tyndall::cli {
namespace {

// Signal handlers can reach nothing but globals.
std::atomic<bool> requested{false};
std::atomic<int> signal_number{0};
std::atomic<const char*> what_to_say{nullptr};

void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

void on_signal(int signal) {
  signal_number = signal;
  requested = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  say(what_to_say);
}

}  // namespace

void catch_stop_signals(const char* message) {
  what_to_say = message;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

void request_stop(const char* message) {
  if (what_to_say == nullptr) std::raise(SIGINT);
  if (requested) return;
  signal_number = SIGINT;
  requested = true;
  say(message);
}

const std::atomic<bool>& stop_requested() { return requested; }
int stop_exit_code() { return signal_number == 0 ? 0 : 128 + signal_number; }

}  // namespace tyndall::cli
