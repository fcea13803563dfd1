#include "report/regress_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// Tests and references never share a seed: those of references have this bit.
constexpr std::uint64_t kReferenceSeeds = std::uint64_t{1} << 62;
constexpr std::uint64_t kSeedsOfACase = 1000;  // the most runs that settings may ask for

std::string read_text(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

/// Plans the runs of one case.
struct Planner {
  const RegressSuite& suite;
  const RegressSettings& settings;
  std::size_t index;  ///< of the case

  Run run(const std::string& name, std::uint64_t seed) const {
    const RegressCase& c = suite.cases[index];
    const std::string base = settings.work_folder + "/" + c.name + "." + name;
    Run run{.of_case = index, .image = base + ".exr", .command = {{}, suite.folder, base + ".json", base + ".log", c.timeout}};
    // In the suite's folder and by its bare name: the scene's path is in the header, and so in the bytes.
    std::vector<std::string>& arguments = run.command.arguments;
    arguments = {settings.program,      "render", c.name + ".pbrt",     "-o",           run.image, "--spp",
                 std::to_string(c.spp), "--seed", std::to_string(seed), "--threads",    "1",       "--json",
                 "--progress",          "none",   "--reproducible",     "--no-adaptive"};
    // Pixels that share their noise would tell less; a case may ask for them in its options.
    if (std::find(c.options.begin(), c.options.end(), "--reuse") == c.options.end())
      arguments.insert(arguments.end(), {"--reuse", "off"});
    if (!c.aovs.empty()) arguments.insert(arguments.end(), {"--aov", joined(c.aovs)});
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    return run;
  }
};

/// The last lines with something in them, as one.
std::string last_words(const std::string& log) {
  std::istringstream stream(log);
  std::string line, words;
  std::vector<std::string> lines;
  while (std::getline(stream, line)) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
  }
  constexpr std::size_t kLines = 3, kLength = 600;
  for (std::size_t i = lines.size() - std::min(lines.size(), kLines); i < lines.size(); ++i) {
    words += (words.empty() ? "" : " | ") + lines[i];
  }
  return words.size() > kLength ? "..." + words.substr(words.size() - kLength) : words;
}

/// Of all that render at a time; --max-memory takes GB.
void share_memory(std::size_t bytes, int jobs, std::vector<Run>& runs) {
  const auto at_a_time = std::clamp<std::size_t>(runs.size(), 1, static_cast<std::size_t>(jobs));
  const std::string share = fmt::format("{}", static_cast<double>(bytes / at_a_time) * 1e-9);
  for (Run& run : runs) run.command.arguments.insert(run.command.arguments.end(), {"--max-memory", share});
}

}  // namespace

int jobs_of(const RegressSettings& settings) {
  return settings.jobs > 0 ? settings.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::vector<Run> plan_runs(const RegressSuite& suite, const RegressSettings& settings) {
  std::vector<Run> runs;
  for (const std::size_t index : select_cases(suite, settings.filter)) {
    const RegressCase& c = suite.cases[index];
    if (!c.fault.empty()) continue;
    const Planner planner{suite, settings, index};
    const int count = settings.update ? c.reference_runs : c.runs;
    const std::uint64_t first = (settings.seed + c.seed) * kSeedsOfACase + (settings.update ? kReferenceSeeds : 0);
    for (int k = 0; k < count; ++k) {
      const std::uint64_t seed = first + static_cast<std::uint64_t>(k);
      runs.push_back(planner.run(std::to_string(seed), seed));
    }
    if (!c.bytes) continue;
    runs.push_back(planner.run("bytes", c.seed));
    runs.back().bytes = true;
  }
  if (settings.max_memory > 0) share_memory(settings.max_memory, jobs_of(settings), runs);
  return runs;
}

RunFault fault_of(const Run& run) {
  const std::string words = last_words(read_text(run.command.log));
  const std::string tail = words.empty() ? "" : ": " + words;
  switch (run.result.end) {
    case ChildResult::End::skipped:
      return {CaseStatus::stopped, "stopped"};
    case ChildResult::End::timed_out: {
      std::ostringstream text;
      text << "killed after " << run.command.timeout << " s; give it a longer \"timeout\" or fewer samples" << tail;
      return {CaseStatus::timeout, text.str()};
    }
    case ChildResult::End::signalled:
      return {CaseStatus::crash, describe_signal(run.result.code) + tail};
    case ChildResult::End::exited:
      break;
  }
  if (run.result.code == 0) return {};
  return {CaseStatus::error, "render ended with exit code " + std::to_string(run.result.code) + tail};
}

LayerTest health_of(const std::vector<const Run*>& runs) {
  std::uint64_t rays = 0, parity = 0, wrong = 0;
  std::ostringstream text;
  for (const Run* run : runs) {
    const auto summary = nlohmann::json::parse(read_text(run->command.out), nullptr, false);
    if (!summary.is_object()) return {.what = "health", .verdict = "the render printed no summary"};
    rays += summary.value("rays", std::uint64_t{0}) + summary.value("shadow_rays", std::uint64_t{0});
    parity += summary.value("parity_errors", std::uint64_t{0});
    for (const char* count : {"non_finite", "majorant_violations", "caps_hit"}) {
      const auto found = summary.value(count, std::uint64_t{0});
      if (found > 0) text << found << " " << count << " in " << fs::path(run->image).stem().string() << "; ";
      wrong += found;
    }
  }
  // A collision can be rounded across a boundary that it grazes: about one in a million rays, which changes nothing.
  const bool parity_kept = parity <= 1 + rays / 1'000'000;
  if (!parity_kept) text << parity << " boundary parity errors in " << rays << " rays";
  return {.what = "health", .same = wrong == 0 && parity_kept, .verdict = text.str()};
}

}  // namespace tyndall
