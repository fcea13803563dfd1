#include "cli/memory.h"

#include <algorithm>

#include "tyndall/memory.h"

namespace tyndall::cli {

std::size_t memory_limit(std::optional<double> gigabytes) {
  constexpr double kMost = 9e18;
  if (gigabytes) return static_cast<std::size_t>(std::min(*gigabytes * 1e9, kMost));
  return usable_memory();
}

}  // namespace tyndall::cli
