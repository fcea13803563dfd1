/// For LD_PRELOAD: the memory runs out once. Counted from where main() begins, allocation number TYNDALL_FAIL_AT gives
/// nothing; with TYNDALL_COUNT_FILE their number is written there in the end.
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<bool> counting{false};
std::atomic<long> count{0};
long fail_at = -1;

/// True: this one fails, and errno says so.
bool next_fails() {
  if (!counting.load(std::memory_order_relaxed) || count.fetch_add(1, std::memory_order_relaxed) + 1 != fail_at) return false;
  errno = ENOMEM;
  return true;
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

// glibc's own, under the names that need no look-up: dlsym() itself allocates.
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

void* malloc(size_t size) { return next_fails() ? nullptr : __libc_malloc(size); }
void* calloc(size_t n, size_t size) { return next_fails() ? nullptr : __libc_calloc(n, size); }
void* realloc(void* p, size_t size) { return next_fails() ? nullptr : __libc_realloc(p, size); }
void* memalign(size_t alignment, size_t size) { return next_fails() ? nullptr : __libc_memalign(alignment, size); }
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** out, size_t alignment, size_t size) {
  *out = memalign(alignment, size);
  return *out || size == 0 ? 0 : ENOMEM;
}

// The first thing that main() does: what comes before is the loader's.
sighandler_t signal(int number, sighandler_t handler) {
  if (number == SIGPIPE && !counting) {
    const char* at = getenv("TYNDALL_FAIL_AT");
    fail_at = at ? atol(at) : -1;
    counting = true;
  }
  return real<sighandler_t(int, sighandler_t)>("signal")(number, handler);
}

__attribute__((destructor)) void report() {
  counting = false;
  const char* path = getenv("TYNDALL_COUNT_FILE");
  FILE* file = path ? fopen(path, "w") : nullptr;
  if (!file) return;
  fprintf(file, "%ld\n", count.load());
  fclose(file);
}

}  // extern "C"
