/// A child process that does everything wrong: none of it reaches this one, and each gets its words.
#include <doctest/doctest.h>

#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <vector>

#include "tyndall/error.h"
#include "volume/vdb_process.h"
#include "volume/vdb_remote.h"

using namespace tyndall;

namespace {

constexpr ProcessLimits kLimits{.memory = std::size_t{256} << 20, .cpu_seconds = 1};

/// How the child ends that does `misdeed` instead of answering.
template <typename Misdeed>
std::string end_of(const Misdeed& misdeed) {
  try {
    WorkerProcess worker(kLimits, [&](ProcessChannel& channel) {
      misdeed();
      channel.put(1);
    });
    worker.get<int>();
  } catch (const ProcessEnded& e) {
    return e.what();
  }
  return "it answered";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("what goes over the channel arrives") {
  WorkerProcess worker(kLimits, [](ProcessChannel& channel) {
    while (true) {
      const auto n = channel.get<std::uint64_t>();
      channel.put_text("number " + std::to_string(n));
      const std::vector<float> values(n, 0.5f);
      channel.send(values.data(), n * sizeof(float));
    }
  });
  for (const std::uint64_t n : {3ull, 1000000ull, 1ull}) {
    worker.put(n);
    CHECK(worker.get_text() == "number " + std::to_string(n));
    std::vector<float> values(n);
    worker.receive(values.data(), n * sizeof(float));
    CHECK(values == std::vector<float>(n, 0.5f));
  }
}

TEST_CASE("a child that crashes, aborts, throws or leaves is told apart and harms nobody") {
  CHECK(contains(end_of([] { raise(SIGSEGV); }), "Segmentation"));
  CHECK(contains(end_of([] { std::abort(); }), "Abort"));
  CHECK(contains(end_of([] { throw 1; }), "gave up"));
  CHECK(contains(end_of([] { _exit(0); }), "gave up"));
  CHECK(contains(end_of([] { raise(SIGKILL); }), "too much memory"));
  CHECK(end_of([] {}) == "it answered");
}

TEST_CASE("a child that computes for ever is ended") {
  const auto start = std::chrono::steady_clock::now();
  const std::string end = end_of([] {
    volatile unsigned i = 0;
    for (;;) i = i + 1;
  });
  CHECK(contains(end, "too long"));
  CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 10);
}

constexpr ProcessLimits kImpatient{.memory = std::size_t{256} << 20, .cpu_seconds = 0.01, .patience = 1};

TEST_CASE("a child that sleeps for ever is not waited for") {
  const auto start = std::chrono::steady_clock::now();
  WorkerProcess worker(kImpatient, [](ProcessChannel&) { pause(); });
  CHECK_THROWS_WITH_AS(worker.get<int>(), doctest::Contains("too long"), ProcessEnded);
  CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 5);
}

TEST_CASE("a child that computes before it answers is not stuck, one that only waits is") {
  const auto work = [](ProcessChannel& channel) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(1500);
    while (std::chrono::steady_clock::now() < end) continue;
    channel.put(1);
  };
  CHECK_FALSE(WorkerProcess({.memory = kLimits.memory, .cpu_seconds = 4}, work).is_stuck(0.8));
  CHECK_FALSE(WorkerProcess(kLimits, [](ProcessChannel&) {}).is_stuck(0.8));
  CHECK(WorkerProcess(kLimits, [](ProcessChannel&) { pause(); }).is_stuck(0.8));
}

namespace {
int* readers = nullptr;  ///< how many were started, seen by all of them
std::unique_ptr<VolumeFile> open_at_the_second_start(const std::string&) {
  if (++*readers == 1) pause();
  throw Error(Failure::scene, "reader " + std::to_string(*readers));
}
}  // namespace

// libtbb's lock, held by a thread of Embree's when the reader was forked, made one read in 5,000 wait for 24 seconds.
TEST_CASE("a reader that waits for what nobody will give is replaced") {
  void* shared = mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  REQUIRE(shared != MAP_FAILED);
  readers = new (shared) int(0);
  CHECK_THROWS_WITH_AS(open_remotely("none.vdb", std::size_t{64} << 20, open_at_the_second_start), "reader 2", Error);
  munmap(shared, sizeof(int));
}

TEST_CASE("time for which the waiting process is stopped does not count") {
  const pid_t waiting = fork();
  if (waiting == 0) {
    WorkerProcess slow(kImpatient, [](ProcessChannel& channel) {
      usleep(2'000'000);
      channel.put(7);
    });
    try {
      _exit(slow.get<int>());
    } catch (const ProcessEnded&) {
      _exit(1);
    }
  }
  usleep(100'000);
  kill(waiting, SIGSTOP);
  usleep(1'500'000);
  kill(waiting, SIGCONT);
  int status = 0;
  REQUIRE(waitpid(waiting, &status, 0) == waiting);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}

#ifndef __SANITIZE_ADDRESS__
TEST_CASE("a child gets no more memory than its limit") {
  const std::string end = end_of([] {
    // Not written to: a slow machine would spend the limit of computing on that.
    std::vector<std::unique_ptr<char[]>> held;
    try {
      for (;;) held.push_back(std::make_unique_for_overwrite<char[]>(std::size_t{16} << 20));
    } catch (const std::bad_alloc&) {
      // More than the limit, since it may use up what this process has freed.
      raise(held.size() < 40 ? SIGUSR1 : SIGUSR2);
    }
  });
  CAPTURE(end);
  CHECK(contains(end, "User defined signal 1"));
}
#endif

TEST_CASE("a text that claims to be huge is refused") {
  WorkerProcess worker(kLimits, [](ProcessChannel& channel) { channel.put(std::uint32_t{0xffffffff}); });
  CHECK_THROWS_AS(worker.get_text(), ProcessEnded);
}

TEST_CASE("a child does not outlive its object") {
  pid_t id = 0;
  {
    WorkerProcess worker(kLimits, [](ProcessChannel& channel) {
      channel.put(getpid());
      channel.get<int>();
    });
    id = worker.get<pid_t>();
    CHECK(kill(id, 0) == 0);
  }
  CHECK(kill(id, 0) != 0);
}
