// A CPU that lacks what the compiler used would end the program by SIGILL, without a word. This file is compiled for every
// x86-64 (src/CMakeLists.txt) and runs before all others. It calls no inline function of C++ headers: of these the linker
// keeps one copy, which may be another file's.
#include <unistd.h>

#include <cstring>

#include "cli/cpu_needs.h"
#include "tyndall/error.h"

namespace tyndall::cli {
namespace {

void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

/// 101: the first that programs may have.
[[gnu::constructor(101)]] void require_cpu() {
  for (const CpuFeature* need = kCpuNeeds; need->name != nullptr; ++need) {
    if (x86_cpu_active(need->index)) continue;
    say("tyndall: this CPU has no ");
    say(need->name);
    say(", which this program was built for; build it anew with cmake -DTYNDALL_ARCH=x86-64, which any CPU runs\n");
    _exit(static_cast<int>(Failure::run_time));
  }
}

}  // namespace
}  // namespace tyndall::cli
