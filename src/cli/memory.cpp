#include "cli/memory.h"

#include <unistd.h>

#include <algorithm>

namespace tyndall::cli {

std::size_t memory_limit(std::optional<double> gigabytes) {
  constexpr double kMost = 9e18;
  if (gigabytes) return static_cast<std::size_t>(std::min(*gigabytes * 1e9, kMost));
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace tyndall::cli
