/// Memory as the kernel tells of it.
#pragma once

#include <cstddef>
#include <string>

namespace tyndall {

/// Of this process, bytes; 0 where there is no /proc.
struct ProcessMemory {
  std::size_t address_space = 0, resident = 0;
};
ProcessMemory process_memory();

/// The lowest limit of memory, bytes, that holds for a process of the control groups `groups`, the text of its
/// /proc/PID/cgroup: of a group itself and of those around it, by their files below `mount`. Of version 2 (memory.max) and
/// 1 (memory.limit_in_bytes) [Linux, Documentation/admin-guide/cgroup-v2.rst, cgroup-v1/memory.rst]. The largest number
/// when nothing is limited. In a container the path in `groups` may be the host's; only the mount itself is there then.
std::size_t control_group_limit(const std::string& groups, const std::string& mount);

}  // namespace tyndall
