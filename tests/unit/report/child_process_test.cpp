#include "report/child_process.h"

#include <doctest/doctest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace tyndall;
using End = ChildResult::End;

namespace {

ChildCommand shell(const std::string& script, double timeout = 20) {
  const std::string here = std::filesystem::current_path();
  return {{"/bin/sh", "-c", script}, "/", here + "/child.out", here + "/child.log", timeout};
}

ChildResult result_of(const ChildCommand& command) {
  ChildResult result;
  run_children({command}, {.skip = {}, .done = [&](std::size_t, const ChildResult& r) { result = r; }});
  return result;
}

std::string content(const std::string& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("a child's exit code, streams and folder") {
  const ChildResult result = result_of(shell("pwd; echo oops >&2; exit 3"));
  CHECK(result.end == End::exited);
  CHECK(result.code == 3);
  CHECK(content("child.out") == "/\n");
  CHECK(content("child.log") == "oops\n");
}

TEST_CASE("a crash is a result") {
  const ChildResult result = result_of(shell("kill -SEGV $$"));
  CHECK(result.end == End::signalled);
  CHECK(result.code == SIGSEGV);
  CHECK(describe_signal(result.code) == "Segmentation fault");
}

TEST_CASE("a hang is ended") {
  const ChildResult result = result_of(shell("exec sleep 60", 0.2));
  CHECK(result.end == End::timed_out);
  CHECK(result.seconds > 0.2);
  CHECK(result.seconds < 20);
}

TEST_CASE("a program that is not there is a result") {
  ChildCommand command = shell("");
  command.arguments = {"/no/such/program"};
  const ChildResult result = result_of(command);
  CHECK(result.end == End::exited);
  CHECK(result.code == 127);
  CHECK(content("child.log") == "No such file or directory");
}

TEST_CASE("children run side by side; those to be skipped and those after a stop do not run") {
  // Each is there and ends once three are: one after the other none would.
  const std::filesystem::path here = std::filesystem::current_path() / "child.meeting";
  std::filesystem::remove_all(here);
  std::filesystem::create_directory(here);
  const std::string script =
      "touch " + here.string() + "/$$; while [ $(ls " + here.string() + " | wc -l) -lt 3 ]; do sleep 0.02; done";
  std::vector<ChildCommand> commands(4, shell(script, 60));
  std::vector<End> ends(4, End::exited);
  run_children(commands, {.at_once = 4,
                          .skip = [](std::size_t i) { return i == 2; },
                          .done = [&](std::size_t i, const ChildResult& r) { ends[i] = r.end; }});
  CHECK(ends == std::vector{End::exited, End::exited, End::skipped, End::exited});

  std::atomic<bool> stop{true};
  run_children(
      commands,
      {.at_once = 2, .skip = {}, .done = [&](std::size_t i, const ChildResult& r) { ends[i] = r.end; }, .stop = &stop});
  CHECK(ends == std::vector(4, End::skipped));
}
