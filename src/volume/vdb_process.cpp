#include "volume/vdb_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>

#include "math/process_memory.h"
#include "tyndall/error.h"

// The address sanitizer reserves terabytes of address space for itself: a limit on it would end the process at once.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TYNDALL_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TYNDALL_SANITIZED 1
#endif
#endif

namespace tyndall {
namespace {

constexpr std::size_t kLongestText = 1 << 16;
constexpr int kPollMilliseconds = 200;  ///< between looks whether the child still lives

void limit(int resource, std::uint64_t soft, std::uint64_t hard) {
  rlimit current{};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &current) != 0) return;
  const rlimit lower{std::min<rlim_t>(current.rlim_cur, soft), std::min<rlim_t>(current.rlim_max, hard)};
  setrlimit(static_cast<__rlimit_resource_t>(resource), &lower);
}

void submit_to(const ProcessLimits& limits, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // never outlives its parent
  if (getppid() != parent) _exit(1);
  limit(RLIMIT_CORE, 0, 0);
  const auto seconds = static_cast<std::uint64_t>(std::ceil(limits.cpu_seconds));
  limit(RLIMIT_CPU, seconds, seconds + 1);
#ifndef TYNDALL_SANITIZED
  const std::uint64_t most = process_memory().address_space + limits.memory;
  limit(RLIMIT_AS, most, most);
#endif
  // A library that aborts explains itself at length; the other side says it in one line.
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, descriptor);
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGTERM}) ::signal(signal, SIG_DFL);
  ::signal(SIGINT, SIG_IGN);  // Ctrl-C is the parent's to handle
}

}  // namespace

// ------------------------------------------------------------------------------------------------ ProcessChannel

ProcessChannel::~ProcessChannel() {
  if (descriptor_ >= 0) close(descriptor_);
}

void ProcessChannel::send(const void* bytes, std::size_t count) {
  const auto* at = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t sent = ::send(descriptor_, at, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) closed();
    at += sent;
    count -= static_cast<std::size_t>(sent);
  }
}

void ProcessChannel::receive(void* bytes, std::size_t count) {
  auto* at = static_cast<char*>(bytes);
  while (count > 0) {
    wait();
    const ssize_t got = recv(descriptor_, at, count, 0);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got <= 0) closed();
    at += got;
    count -= static_cast<std::size_t>(got);
  }
}

void ProcessChannel::put_text(const std::string& text) {
  put(static_cast<std::uint32_t>(text.size()));
  send(text.data(), text.size());
}

std::string ProcessChannel::get_text() {
  const auto size = get<std::uint32_t>();
  if (size > kLongestText) throw ProcessEnded("makes its reader talk nonsense; it is damaged");
  std::string text(size, '\0');
  receive(text.data(), size);
  return text;
}

// ------------------------------------------------------------------------------------------ WorkerProcess

WorkerProcess::WorkerProcess(const ProcessLimits& limits, const std::function<void(ProcessChannel&)>& serve)
    : ProcessChannel(-1), limits_(limits) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(Failure::run_time, std::string("no channel to another process can be made: ") + std::strerror(errno));
  const pid_t parent = getpid();
  child_ = fork();
  if (child_ == 0) {
    close(ends[0]);
    submit_to(limits, parent);
    int code = 0;
    try {
      ProcessChannel channel(ends[1]);
      serve(channel);
    } catch (...) {
      code = 1;
    }
    _exit(code);  // no destructors, no buffers: they are the parent's
  }
  close(ends[1]);
  descriptor_ = ends[0];
  if (child_ < 0) throw Error(Failure::run_time, std::string("no process can be started: ") + std::strerror(errno));
}

WorkerProcess::~WorkerProcess() {
  if (child_ <= 0 || ended_) return;
  kill(child_, SIGKILL);
  while (waitpid(child_, &status_, 0) < 0 && errno == EINTR) {
  }
}

bool WorkerProcess::has_ended() const {
  if (!ended_) ended_ = waitpid(child_, &status_, WNOHANG) == child_;
  return ended_;
}

bool WorkerProcess::is_stuck(double seconds) const {
  timespec before{};
  for (int idle = 0; idle * kPollMilliseconds < seconds * 1000; ++idle) {
    pollfd watched{descriptor_, POLLIN, 0};
    if (poll(&watched, 1, kPollMilliseconds) > 0 || has_ended()) return false;
    clockid_t clock{};
    timespec computed{};
    if (clock_getcpuclockid(child_, &clock) != 0 || clock_gettime(clock, &computed) != 0) return false;
    if (computed.tv_sec != before.tv_sec || computed.tv_nsec != before.tv_nsec) idle = 0;
    before = computed;
  }
  return true;
}

/// Counts looks, not the time of a clock, which goes on while both processes are stopped (Ctrl-Z).
void WorkerProcess::wait() {
  const double most_looks = (limits_.patience + 4 * limits_.cpu_seconds) * 1000 / kPollMilliseconds;
  for (int looks = 0; looks <= most_looks;) {
    pollfd watched{descriptor_, POLLIN, 0};
    const int ready = poll(&watched, 1, kPollMilliseconds);
    if (ready > 0) return;
    if (ready == 0) ++looks;
    // Its end of the channel may be held open by another child made at the same time: look at the process itself.
    if (has_ended() && poll(&watched, 1, 0) <= 0) closed();
  }
  throw ProcessEnded("takes too long to read; it is damaged, or on a disk that does not answer");
}

void WorkerProcess::closed() const {
  for (int i = 0; i < 50 && !has_ended(); ++i) usleep(2000);  // it closes its end just before it is gone
  if (ended_ && WIFSIGNALED(status_)) {
    const int signal = WTERMSIG(status_);
    if (signal == SIGXCPU || signal == SIGKILL) throw ProcessEnded("takes too long or too much memory to read; it is damaged");
    const char* name = sigdescr_np(signal);
    throw ProcessEnded(std::string("makes its reader crash (") + (name ? name : "unknown signal") + "); it is damaged");
  }
  throw ProcessEnded("cannot be read: its reader gave up");
}

}  // namespace tyndall
