/// The only interface to the thread library.
#pragma once

#ifdef TYNDALL_STD_THREADS
#include "math/std_thread_pool.h"
#else

#include <cstddef>

#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

namespace tyndall {

inline constexpr bool kThreadsAreWatched = false;  ///< by a sanitizer

/// A pool of `threads` threads (<= 0: one a core) that runs work given to it.
class ThreadPool {
 public:
  explicit ThreadPool(int threads) : arena_(threads > 0 ? threads : tbb::task_arena::automatic) {
    // More threads than cores must be allowed, or those asked for beyond the cores never come.
    if (threads > 0) limit_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }

  int size() const { return arena_.max_concurrency(); }

  /// body(i) for i in [0, count), in any order, `grain` at a time. The first exception thrown is rethrown here.
  template <typename Body>
  void for_each(std::size_t count, std::size_t grain, const Body& body) {
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const tbb::blocked_range<std::size_t>& r) {
        for (std::size_t i = r.begin(); i != r.end(); ++i) body(i);
      });
    });
  }

 private:
  std::optional<tbb::global_control> limit_;
  tbb::task_arena arena_;
};

}  // namespace tyndall

#endif
