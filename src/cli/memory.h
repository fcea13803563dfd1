/// How much memory a command may plan with.
#pragma once

#include <cstddef>
#include <optional>

namespace tyndall::cli {

/// Bytes: `gigabytes` of --max-memory if given, else what the process may hold.
std::size_t memory_limit(std::optional<double> gigabytes);

}  // namespace tyndall::cli
