/// Work on untrusted data in a process of its own: what goes wrong there (a crash, a hang, all memory) stays there.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace tyndall {

struct ProcessLimits {
  std::size_t memory = 0;  ///< bytes beyond what this process has
  double cpu_seconds = 0;  ///< of computing
  double patience = 8;     ///< seconds that are waited for a byte, beside four times the limit of computing
};

/// The other side is gone, or said something that cannot be. what(): how it ended, to follow "the file ".
struct ProcessEnded : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One end of a two-way stream of bytes between two processes on one machine.
class ProcessChannel {
 public:
  explicit ProcessChannel(int descriptor) : descriptor_(descriptor) {}
  ProcessChannel(const ProcessChannel&) = delete;
  ProcessChannel& operator=(const ProcessChannel&) = delete;
  virtual ~ProcessChannel();

  void send(const void* bytes, std::size_t count);
  void receive(void* bytes, std::size_t count);

  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    send(&value, sizeof value);
  }
  template <typename T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    receive(&value, sizeof value);
    return value;
  }
  void put_flag(bool flag) { put(static_cast<std::uint8_t>(flag)); }
  bool get_flag() { return get<std::uint8_t>() != 0; }
  void put_text(const std::string& text);
  std::string get_text();  ///< at most 64 KB

 protected:
  /// Returns when bytes can be read; throws ProcessEnded when none will come.
  virtual void wait() {}
  [[noreturn]] virtual void closed() const { throw ProcessEnded("was closed"); }
  int descriptor_;
};

/// A child process. Reading from it waits no longer than it lives and than its limits allow; time for which this process is
/// stopped is not waited.
class WorkerProcess : public ProcessChannel {
 public:
  /// Runs `serve` in the child, under `limits` and without a terminal; the child ends when that returns or throws.
  /// Nothing that `serve` changes is seen here. Throws Error (run_time) when no process can be made.
  WorkerProcess(const ProcessLimits& limits, const std::function<void(ProcessChannel&)>& serve);
  ~WorkerProcess() override;  ///< ends the child

  /// Waits for the first byte or the end; true when the child has neither computed nor sent for `seconds`. A fork copies the
  /// locks of libraries but not the threads that hold them, so a child can wait for ever where the next one does not.
  bool is_stuck(double seconds) const;

 private:
  void wait() override;
  [[noreturn]] void closed() const override;
  bool has_ended() const;

  ProcessLimits limits_;
  pid_t child_ = -1;
  mutable int status_ = 0;
  mutable bool ended_ = false;
};

}  // namespace tyndall
