/// How long things take: the one clock.
#pragma once

#include <chrono>

namespace tyndall {

class Timer {
 public:
  double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }  ///< since it was made, or lap()
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
