/// The thread pool for builds under a thread sanitizer, of std::thread alone. TBB is not instrumented: a sanitizer does not
/// see how it hands work over and reports races that are none, and what silences those silences all that run in it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tyndall {

inline constexpr bool kThreadsAreWatched = true;

class ThreadPool {
 public:
  explicit ThreadPool(int threads)
      : size_(threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) {}

  int size() const { return size_; }

  template <typename Body>
  void for_each(std::size_t count, std::size_t grain, const Body& body) {
    // Relaxed, so that taking work orders nothing else: what two bodies share they must guard themselves.
    std::atomic<std::size_t> next{0};
    std::exception_ptr first;
    std::mutex mutex;
    const auto work = [&] {
      try {
        for (;;) {
          const std::size_t begin = next.fetch_add(grain, std::memory_order_relaxed);
          if (begin >= count) return;
          for (std::size_t i = begin; i < std::min(begin + grain, count); ++i) body(i);
        }
      } catch (...) {
        next.store(count, std::memory_order_relaxed);
        const std::scoped_lock lock(mutex);
        if (!first) first = std::current_exception();
      }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < size_; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    if (first) std::rethrow_exception(first);
  }

 private:
  int size_;
};

}  // namespace tyndall
