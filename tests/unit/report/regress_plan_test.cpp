#include "report/regress_plan.h"

#include <doctest/doctest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

using namespace tyndall;
using End = ChildResult::End;

namespace {

RegressSuite two_cases() {
  RegressSuite suite{"suite", {}};
  suite.cases.push_back({.name = "fog", .spp = 8, .aovs = {"N", "Z"}, .bytes = true, .options = {"--max-depth", "2"}});
  suite.cases.push_back({.name = "lamp", .runs = 3, .reference_runs = 5});
  return suite;
}

RegressSettings settings(std::uint64_t seed = 0, bool update = false) {
  return {.program = "/bin/tyndall", .work_folder = "/work", .filter = "", .seed = seed, .update = update};
}

std::string argument_after(const Run& run, const std::string& option) {
  const auto& a = run.command.arguments;
  const auto found = std::find(a.begin(), a.end(), option);
  return found == a.end() || found + 1 == a.end() ? "" : *(found + 1);
}

std::set<std::string> seeds_of(const std::vector<Run>& runs, std::size_t of_case) {
  std::set<std::string> seeds;
  for (const Run& run : runs) {
    if (run.of_case == of_case && !run.bytes) CHECK(seeds.insert(argument_after(run, "--seed")).second);
  }
  return seeds;
}

/// A run that ended so, having printed `summary` and `log`.
Run ended(End end, int code, const std::string& summary, const std::string& log) {
  const std::string here = std::filesystem::current_path();
  Run run{.image = here + "/plan.exr",
          .command = {{}, "/", here + "/plan.json", here + "/plan.log", 1.5},
          .result = {end, code, 1}};
  std::ofstream(run.command.out) << summary;
  std::ofstream(run.command.log) << log;
  return run;
}

}  // namespace

TEST_CASE("a case is rendered by its runs, each in the suite's folder with its settings") {
  const std::vector<Run> runs = plan_runs(two_cases(), settings());
  REQUIRE(runs.size() == 4 + 1 + 3);
  const Run& first = runs.front();
  CHECK(first.command.folder == "suite");
  CHECK(first.command.arguments[0] == "/bin/tyndall");
  CHECK(first.command.arguments[2] == "fog.pbrt");
  const auto& given = first.command.arguments;
  CHECK(std::find(given.begin(), given.end(), "--no-adaptive") != given.end());  // whatever the scene asks for
  CHECK(argument_after(first, "--spp") == "8");
  CHECK(argument_after(first, "--aov") == "N,Z");
  CHECK(argument_after(first, "--max-depth") == "2");
  CHECK(argument_after(first, "-o") == first.image);
  CHECK(runs[4].bytes);
  CHECK(argument_after(runs[4], "--seed") == "0");
}

TEST_CASE("tests of one seed, of another and references share no random numbers; bytes have their own seed always") {
  std::set<std::string> all;
  std::size_t count = 0;
  for (const auto& s : {settings(0), settings(1), settings(7), settings(0, true)}) {
    const std::vector<Run> runs = plan_runs(two_cases(), s);
    const auto seeds = seeds_of(runs, 0);
    CHECK(seeds.size() == (s.update ? 16 : 4));
    count += seeds.size();
    all.insert(seeds.begin(), seeds.end());
    CHECK(argument_after(runs[seeds.size()], "--seed") == "0");
  }
  CHECK(all.size() == count);
}

TEST_CASE("renders share the memory with those that run at the same time") {
  RegressSettings s = settings();
  CHECK(argument_after(plan_runs(two_cases(), s).front(), "--max-memory").empty());
  s.max_memory = 6'000'000'000;
  const auto share = [&](int jobs) {
    s.jobs = jobs;
    return std::stod(argument_after(plan_runs(two_cases(), s).back(), "--max-memory"));
  };
  CHECK(share(1) == doctest::Approx(6));
  CHECK(share(4) == doctest::Approx(1.5));
  CHECK(share(100) == doctest::Approx(6.0 / 8));  // there are no more than 8
}

TEST_CASE("how a run ended") {
  CHECK(fault_of(ended(End::exited, 0, "", "note: all is well\n")).status == CaseStatus::pass);
  const RunFault error = fault_of(ended(End::exited, 3, "", "one\ntwo\n\nthree\nx.pbrt:3:1: unknown\n"));
  CHECK(error.status == CaseStatus::error);
  CHECK(error.message == "render ended with exit code 3: two | three | x.pbrt:3:1: unknown");
  CHECK(fault_of(ended(End::signalled, SIGSEGV, "", "")).message == "Segmentation fault");
  CHECK(fault_of(ended(End::signalled, SIGSEGV, "", "")).status == CaseStatus::crash);
  CHECK(fault_of(ended(End::timed_out, SIGKILL, "", "")).message.starts_with("killed after 1.5 s"));
  CHECK(fault_of(ended(End::skipped, 0, "", "")).status == CaseStatus::stopped);
}

TEST_CASE("counts that a correct render has not are found") {
  const auto health = [](const std::string& counts) {
    const Run run = ended(End::exited, 0, "{\"rays\": 3000000, \"shadow_rays\": 0" + counts + "}", "");
    return health_of({&run});
  };
  CHECK(health("").same);
  CHECK(health(", \"parity_errors\": 4").same);
  CHECK_FALSE(health(", \"parity_errors\": 5").same);
  for (const char* count : {"non_finite", "majorant_violations", "caps_hit"}) {
    const LayerTest test = health(std::string(", \"") + count + "\": 1");
    CHECK_FALSE(test.same);
    CHECK(test.verdict.find(count) != std::string::npos);
  }
  const Run silent = ended(End::exited, 0, "", "");
  CHECK_FALSE(health_of({&silent}).same);
}
