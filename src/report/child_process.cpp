#include "report/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <thread>

#include "tyndall/error.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

constexpr auto kPoll = std::chrono::milliseconds(4);
constexpr int kCouldNotStart = 127;  // as a shell says it

struct Child {
  std::size_t index;
  pid_t id;
  Timer running;
};

/// What a child needs, made before the fork: after it nothing may be allocated.
struct Prepared {
  std::vector<char*> arguments;
  const char *folder, *out, *log;
  pid_t parent;
};

void redirect(const char* path, int descriptor) {
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0 || dup2(file, descriptor) < 0) _exit(kCouldNotStart);
  close(file);
}

[[noreturn]] void become(const Prepared& prepared) {
  redirect("/dev/null", STDIN_FILENO);
  redirect(prepared.log, STDERR_FILENO);
  redirect(prepared.out, STDOUT_FILENO);
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // never outlives who waits for it
  if (getppid() != prepared.parent) _exit(kCouldNotStart);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);  // a crash is expected now and then; its core is not
  if (chdir(prepared.folder) == 0) execv(prepared.arguments[0], prepared.arguments.data());
  const char* why = std::strerror(errno);
  if (write(STDERR_FILENO, why, std::strlen(why)) < 0) _exit(kCouldNotStart);
  _exit(kCouldNotStart);
}

Child start(const ChildCommand& command, std::size_t index) {
  Prepared prepared{{}, command.folder.c_str(), command.out.c_str(), command.log.c_str(), getpid()};
  for (const std::string& a : command.arguments) prepared.arguments.push_back(const_cast<char*>(a.c_str()));
  prepared.arguments.push_back(nullptr);
  const pid_t id = fork();
  if (id < 0) throw Error(Failure::run_time, std::string("no process can be started: ") + std::strerror(errno));
  if (id == 0) become(prepared);
  return {index, id, {}};
}

/// How the child ended; nothing while it runs.
std::optional<ChildResult> ended(const Child& child) {
  int status = 0;
  if (waitpid(child.id, &status, WNOHANG) != child.id) return std::nullopt;
  if (WIFSIGNALED(status)) return ChildResult{ChildResult::End::signalled, WTERMSIG(status), child.running.seconds()};
  return ChildResult{ChildResult::End::exited, WEXITSTATUS(status), child.running.seconds()};
}

ChildResult end_by_force(const Child& child, ChildResult::End why) {
  kill(child.id, SIGKILL);
  int status = 0;
  while (waitpid(child.id, &status, 0) < 0 && errno == EINTR) {
  }
  return {why, SIGKILL, child.running.seconds()};
}

/// Result of a child that needs no more waiting.
std::optional<ChildResult> finished(const Child& child, double timeout, bool stopped) {
  if (auto result = ended(child)) return result;
  if (stopped) return end_by_force(child, ChildResult::End::skipped);
  if (child.running.seconds() > timeout) return end_by_force(child, ChildResult::End::timed_out);
  return std::nullopt;
}

/// Children that run; none outlives the list of them, also when a callback throws.
struct Running {
  std::vector<Child> list;

  Running() = default;
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    for (const Child& child : list) end_by_force(child, ChildResult::End::skipped);
  }
};

}  // namespace

void run_children(const std::vector<ChildCommand>& commands, const ChildControl& control) {
  Running children;
  std::vector<Child>& running = children.list;
  std::size_t next = 0;
  while (next < commands.size() || !running.empty()) {
    const bool stopped = control.stop != nullptr && control.stop->load();
    while (next < commands.size() && running.size() < static_cast<std::size_t>(control.at_once)) {
      const std::size_t index = next++;
      if (stopped || (control.skip && control.skip(index))) {
        control.done(index, {});
      } else {
        running.push_back(start(commands[index], index));
      }
    }
    for (std::size_t i = 0; i < running.size();) {
      const Child child = running[i];
      const auto result = finished(child, commands[child.index].timeout, stopped);
      if (!result) {
        ++i;
        continue;
      }
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      control.done(child.index, *result);
    }
    if (!running.empty()) std::this_thread::sleep_for(kPoll);
  }
}

std::string describe_signal(int signal) {
  const char* name = sigdescr_np(signal);
  return name != nullptr ? name : "signal " + std::to_string(signal);
}

}  // namespace tyndall
