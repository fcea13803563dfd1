#include "watch.h"

namespace tyndall::python {
namespace {

constexpr auto kLook = std::chrono::milliseconds(50);  ///< between looks at signals

/// The work in its thread.
class Work {
 public:
  explicit Work(const std::function<void()>& work) : thread_([this, &work] { run(work); }) {}

  /// True when it has ended.
  bool wait() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, kLook, [this] { return done_; });
  }
  /// What it threw, if it did.
  std::exception_ptr join() {
    thread_.join();
    return failure_;
  }

 private:
  void run(const std::function<void()>& work) {
    try {
      work();
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    done_ = true;
    ended_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

/// Python's exception, if a signal or the callback has raised one.
std::exception_ptr look(Watched& watched) {
  const py::gil_scoped_acquire gil;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (const auto news = watched.take_news()) news();
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

void run_watched(Watched& watched, const std::function<void()>& work) {
  std::exception_ptr raised, failed;
  {
    const py::gil_scoped_release free;
    Work running(work);
    for (bool done = false; !done;) {
      done = running.wait();
      if (!raised) raised = look(watched);
      if (raised) watched.stop = true;
    }
    failed = running.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (failed) std::rethrow_exception(failed);
}

}  // namespace tyndall::python
