/// How much memory there is. Bytes, all of them.
#pragma once

#include <cstddef>
#include <optional>

namespace tyndall {

/// What the machine has.
std::size_t physical_memory();

/// What this process may hold: physical_memory(), or less where a control group (a container, a batch job) is limited to
/// less. For BuildSettings::max_memory.
std::size_t usable_memory();
/// `gigabytes`, above 0, as --max-memory has them; else usable_memory().
std::size_t memory_limit(std::optional<double> gigabytes);

}  // namespace tyndall
