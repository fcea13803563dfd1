#include "io/atomic_file.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
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

/// "node7.1234", with the name of this machine as temporary files have it.
std::string here(const std::string& process) {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  std::string host = std::string(name).substr(0, 40);
  for (char& c : host) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return host + "." + process;
}

TEST_CASE("what a killed process of this machine left of writing a file is removed, and nothing else") {
  const test::Scratch folder;
  const std::string number = gone(), dead = here(number), alive = here(std::to_string(getpid()));
  const std::string kept[] = {".a.exr." + alive + ".0.part",
                              ".b.exr." + dead + ".0.part",
                              ".a.exr." + dead + ".0.partial",
                              "a.exr." + dead + ".0.part",
                              ".a.exr." + dead + ".x.part",
                              ".a.exr." + here("-1.0.part"),
                              ".a.exr." + here("0.0.part"),
                              ".a.exr." + here("99999999999999999.0.part"),
                              ".a.exr.another-" + dead + ".0.part",
                              ".a.exr." + number + ".0.part",
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
