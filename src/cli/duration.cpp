#include "cli/duration.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall::cli {

std::string duration(double seconds) {
  const auto s = static_cast<long long>(std::lround(std::min(seconds, 1e9)));
  if (s < 60) return fmt::format("{}s", s);
  if (s < 3600) return fmt::format("{}m{:02}s", s / 60, s % 60);
  return fmt::format("{}h{:02}m", s / 3600, s / 60 % 60);
}

}  // namespace tyndall::cli
