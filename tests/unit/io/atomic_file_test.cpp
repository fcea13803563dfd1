#include "io/atomic_file.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "support/scratch.h"

namespace tyndall {
namespace {

/// The number of a process that is no more.
std::string gone() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return std::to_string(child);
}

TEST_CASE("what a killed process left of writing a file is removed, and nothing else") {
  const test::Scratch folder;
  const std::string dead = gone(), alive = std::to_string(getpid());
  const std::string kept[] = {".a.exr." + alive + ".0.part",
                              ".b.exr." + dead + ".0.part",
                              ".a.exr." + dead + ".0.partial",
                              "a.exr." + dead + ".0.part",
                              ".a.exr." + dead + ".x.part",
                              ".a.exr.-1.0.part",
                              ".a.exr.0.0.part",
                              ".a.exr.99999999999999999.0.part",
                              ".a.exr." + dead + ".part",
                              ".a.exr.x." + dead + ".0.part",
                              "a.exr"};
  const std::string left[] = {".a.exr." + dead + ".0.part", ".a.exr." + dead + ".17.part"};
  for (const std::string& name : kept) test::write_bytes(folder / name, "x");
  for (const std::string& name : left) test::write_bytes(folder / name, "x");
  remove_abandoned_files(folder / "a.exr");
  for (const std::string& name : kept) CHECK_MESSAGE(std::filesystem::exists(folder / name), name);
  for (const std::string& name : left) CHECK_MESSAGE(!std::filesystem::exists(folder / name), name);
  remove_abandoned_files(folder / "no/such/folder/a.exr");
}

TEST_CASE("a file being written is under a name that would be found if its process were killed") {
  const test::Scratch folder;
  const pid_t child = fork();
  if (child == 0) {
    const AtomicFile file(folder / "a.exr");
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
  CHECK(folder.file_count() == 1);
  remove_abandoned_files(folder / "a.exr");
  CHECK(folder.file_count() == 0);
}

}  // namespace
}  // namespace tyndall
