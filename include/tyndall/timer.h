/// How long things take: the one clock.
#pragma once

#include <chrono>

namespace tyndall {

class Timer {
 public:
  /// Since it was made, or lap().
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// Seconds likewise; starts anew.
  double lap() {
    const double elapsed = seconds();
    start_ = Clock::now();
    return elapsed;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace tyndall
