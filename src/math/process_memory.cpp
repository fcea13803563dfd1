#include "math/process_memory.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>

#include "tyndall/memory.h"

namespace tyndall {
namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

std::size_t page_size() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

/// The number in a file; kUnlimited when there is no such file, or it says "max".
std::size_t limit_in(const std::string& path) {
  std::size_t bytes = 0;
  return std::ifstream(path) >> bytes ? bytes : kUnlimited;
}

/// Of the groups from `group` ("/jobs/17") up to the root, each with a file `name` in its folder below `mount`.
std::size_t lowest_limit(const std::string& mount, std::string group, const std::string& name) {
  std::size_t limit = limit_in(mount + "/" + name);
  while (group.size() > 1) {
    limit = std::min(limit, limit_in(mount + group + "/" + name));
    group.resize(group.find_last_of('/'));
  }
  return limit;
}

/// Version 1's group for memory, version 2's group; what a line "4:memory,pids:/jobs/17" or "0::/jobs/17" says.
struct Group {
  bool version_1 = false;
  std::string path;
};
std::optional<Group> parse_group(const std::string& line) {
  const std::size_t first = line.find(':'), second = line.find(':', first + 1);
  if (first == std::string::npos || second == std::string::npos || line.compare(second, 2, ":/") != 0) return std::nullopt;
  const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
  const bool memory = controllers.find(",memory,") != std::string::npos;
  if (!memory && controllers != ",,") return std::nullopt;
  return Group{memory, line.substr(second + 1)};
}

}  // namespace

ProcessMemory process_memory() {
  unsigned long all = 0, held = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%lu %lu", &all, &held) != 2) all = held = 0;
    std::fclose(file);
  }
  return {all * page_size(), held * page_size()};
}

std::size_t control_group_limit(const std::string& groups, const std::string& mount) {
  std::size_t limit = kUnlimited;
  std::istringstream lines(groups);
  for (std::string line; std::getline(lines, line);) {
    const auto group = parse_group(line);
    if (!group) continue;
    limit = std::min(limit, group->version_1 ? lowest_limit(mount + "/memory", group->path, "memory.limit_in_bytes")
                                             : lowest_limit(mount, group->path, "memory.max"));
  }
  return limit;
}

std::size_t physical_memory() { return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * page_size(); }

std::size_t usable_memory() {
  std::ifstream file("/proc/self/cgroup");
  const std::string groups{std::istreambuf_iterator<char>(file), {}};
  return std::min(physical_memory(), control_group_limit(groups, "/sys/fs/cgroup"));
}

std::size_t memory_limit(std::optional<double> gigabytes) {
  constexpr double kMost = 9e18;
  if (gigabytes) return static_cast<std::size_t>(std::min(*gigabytes * 1e9, kMost));
  return usable_memory();
}

}  // namespace tyndall
