#include "math/process_memory.h"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "support/scratch.h"
#include "tyndall/memory.h"

namespace tyndall {
namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

TEST_CASE("the lowest limit among the control groups of a process and those around them holds") {
  const test::Scratch mount;
  const auto put = [&](const std::string& folder, const std::string& name, const std::string& text) {
    std::filesystem::create_directories(mount / folder);
    test::write_bytes(mount / (folder + "/" + name), text);
  };
  const auto limit = [&](const std::string& groups) { return control_group_limit(groups, mount / "."); };

  CHECK(limit("0::/jobs/17\n") == kUnlimited);  // no files
  put("jobs/17", "memory.max", "max\n");
  CHECK(limit("0::/jobs/17\n") == kUnlimited);
  put("jobs", "memory.max", "5000000\n");
  CHECK(limit("0::/jobs/17\n") == 5000000);
  put("jobs/17", "memory.max", "4000000\n");
  CHECK(limit("0::/jobs/17\n") == 4000000);
  CHECK(limit("0::/jobs\n") == 5000000);
  CHECK(limit("0::/others\n") == kUnlimited);
  put(".", "memory.max", "3000000\n");  // a container: its own group is the mount
  CHECK(limit("0::/docker/abc\n") == 3000000);

  put("memory/a", "memory.limit_in_bytes", "2000000\n");
  put("memory", "memory.limit_in_bytes", "9223372036854771712\n");  // what version 1 writes for no limit
  CHECK(limit("9:name=systemd:/\n4:cpu,memory:/a/b\n") == 2000000);
  CHECK(limit("4:memory:/c\n") == 9223372036854771712u);
  CHECK(limit("4:cpu:/a\n") == kUnlimited);
  CHECK(limit("4:memory:/a\n0::/\n") == 2000000);
  for (const char* nonsense : {"", "\n", "memory", "4:memory", "0::", "0::x\n", ":::::\n"})
    CHECK(limit(nonsense) == kUnlimited);
}

TEST_CASE("this process holds some of what the machine has, and its memory is seen to grow") {
  CHECK(usable_memory() <= physical_memory());
  CHECK(usable_memory() > std::size_t{1} << 24);
  const ProcessMemory before = process_memory();
  CHECK(before.resident > 0);
  CHECK(before.resident < before.address_space);
  CHECK(before.resident < physical_memory());
  constexpr std::size_t kSize = std::size_t{64} << 20;
  const std::vector<char> block(kSize, 1);
  CHECK(process_memory().resident > before.resident + kSize / 2);
}

}  // namespace
}  // namespace tyndall
