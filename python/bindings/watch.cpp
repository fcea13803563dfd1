#include "watch.h"

#include <unistd.h>

#include <set>

namespace tyndall::python {
namespace {

constexpr auto kLook = std::chrono::milliseconds(50);  ///< between looks at signals

/// Works under way. The interpreter's end waits for them: what their threads stand on goes with the process.
class UnderWay {
 public:
  /// False: the interpreter has ended for this thread.
  bool add(Watched& watched) {
    const std::lock_guard lock(mutex_);
    if (is_late()) return false;
    works_.insert({getpid(), &watched});
    return true;
  }
  void remove(Watched& watched) {
    const std::lock_guard lock(mutex_);
    works_.erase({getpid(), &watched});
    changed_.notify_all();
  }
  bool has_ended() {
    const std::lock_guard lock(mutex_);
    return is_late();
  }
  /// Stops all, and waits for them.
  void end() {
    std::unique_lock lock(mutex_);
    last_thread_ = std::this_thread::get_id();
    std::erase_if(works_, [](const auto& work) { return work.first != getpid(); });  // a fork has none of the threads
    for (const auto& [process, watched] : works_) watched->stop = true;
    changed_.wait(lock, [this] { return works_.empty(); });
  }

 private:
  bool is_late() const { return last_thread_ && *last_thread_ != std::this_thread::get_id(); }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<std::pair<pid_t, Watched*>> works_;
  std::optional<std::thread::id> last_thread_;  ///< that ends the interpreter, and may go on with it
};

/// Never destroyed: daemon threads outlive what is.
UnderWay& under_way() {
  static auto* const works = new UnderWay;
  return *works;
}

/// Of a daemon thread, without the GIL, when the interpreter has ended: there is nothing to come back to, and Python would end
/// the thread by unwinding it, without the GIL, through what lives here.
[[noreturn]] void stay() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Among the works under way, from its making to end().
class Place {
 public:
  explicit Place(Watched& watched) : watched_(watched) {
    if (under_way().add(watched_)) return;
    PyEval_SaveThread();
    stay();
  }
  ~Place() { end(); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  void end() { under_way().remove(watched_); }

 private:
  Watched& watched_;
};

/// The work in its thread.
class Work {
 public:
  Work(Watched& watched, const std::function<void()>& work)
      : watched_(watched), place_(watched), thread_([this, &work] { run(work); }) {}
  /// Left early when Python ends this thread, which it does where the GIL is taken.
  ~Work() {
    watched_.stop = true;
    if (thread_.joinable()) thread_.join();
  }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  /// True when it has ended. Meanwhile the GIL is free; no destructor takes it back, since that may unwind.
  bool wait() {
    PyThreadState* const state = PyEval_SaveThread();
    const bool done = is_done();
    if (under_way().has_ended()) stay();
    PyEval_RestoreThread(state);
    return done;
  }
  /// What it threw, if it did.
  std::exception_ptr join() {
    thread_.join();
    return failure_;
  }

 private:
  bool is_done() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, kLook, [this] { return done_; });
  }
  void run(const std::function<void()>& work) {
    try {
      work();
    } catch (...) {
      failure_ = std::current_exception();
    }
    place_.end();
    const std::lock_guard lock(mutex_);
    done_ = true;
    ended_.notify_one();
  }

  Watched& watched_;
  Place place_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

/// Python's exception, if a signal or the callback has raised one. Others pass: the interpreter's end unwinds like one.
std::exception_ptr look(Watched& watched) {
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (const auto news = watched.take_news()) news();
  } catch (const std::exception&) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

void run_watched(Watched& watched, const std::function<void()>& work) {
  Work running(watched, work);
  std::exception_ptr raised;
  for (bool done = false; !done;) {
    done = running.wait();
    if (!raised) raised = look(watched);
    if (raised) watched.stop = true;
  }
  const std::exception_ptr failed = running.join();
  if (raised) std::rethrow_exception(raised);
  if (failed) std::rethrow_exception(failed);
}

void end_works() {
  const py::gil_scoped_release free;
  under_way().end();
}

}  // namespace tyndall::python
