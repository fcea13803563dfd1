/// Long work beside the interpreter: the GIL is free while it runs, and Ctrl-C ends it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "convert.h"

namespace tyndall::python {

/// What the work is told and tells.
struct Watched {
  std::atomic<bool> stop{false};  ///< set when Python wants it to end

  /// From the work's threads: what Python's callback is to be told. Only the last one counts.
  void tell(std::function<void()> news) {
    const std::lock_guard lock(mutex_);
    news_ = std::move(news);
  }
  std::function<void()> take_news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, {});
  }

 private:
  std::mutex mutex_;
  std::function<void()> news_;
};

/// Runs `work` in a thread of its own while this one, which holds the GIL but for looks at signals, waits. A signal's exception
/// or one of the callback stops the work and is thrown when that has ended.
void run_watched(Watched& watched, const std::function<void()>& work);

/// For the interpreter's end: stops all works, of daemon threads, and waits until they have ended.
void end_works();

}  // namespace tyndall::python
