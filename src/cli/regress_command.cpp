#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "cli/command.h"
#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/print.h"
#include "cli/save.h"
#include "cli/stop_signal.h"
#include "cli/validators.h"
#include "report/page.h"
#include "report/regress.h"
#include "report/regress_results.h"
#include "tyndall/io.h"
#include "tyndall/memory.h"
#include "tyndall/utf8.h"

namespace tyndall::cli {
namespace {

namespace fs = std::filesystem;

struct RegressOptions {
  std::string suite, report, junit;
  std::optional<double> max_memory;
  RegressSettings settings;
  bool json = false;
};

/// A folder for the runs, gone with everything in it when the suite has ended. mkdtemp() writes a name of its own over
/// the X of its template.
class ScratchFolder {
 public:
  ScratchFolder() : path_(fs::absolute(fs::temp_directory_path()) / "tyndall-regress-XXXXXX") {
    if (mkdtemp(path_.data()) == nullptr)
      throw Error(Failure::output, path_ + ": cannot be made; set TMPDIR to a folder with room");
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// This very program.
std::string own_path() {
  std::error_code problem;
  const fs::path path = fs::read_symlink("/proc/self/exe", problem);
  if (problem) throw Error(Failure::run_time, "/proc/self/exe: cannot be read; regress starts itself and needs /proc");
  return path;
}

std::size_t longest_name(const RegressSuite& suite) {
  std::size_t width = 4;
  for (const RegressCase& c : suite.cases) width = std::max(width, utf8_count(c.name));
  return width;
}

void write_report(const SuiteResult& result, const std::string& folder) {
  make_folder(folder + "/renders");
  std::vector<PagePicture> pictures;
  for (const CaseResult& c : result.cases) {
    if (c.render) write_exr(*c.render, folder + "/renders/" + c.name + ".exr");
    if (c.reference) pictures.push_back({c.name, "reference", *c.reference});
    if (c.render) pictures.push_back({c.name, "render", *c.render});
  }
  const nlohmann::ordered_json results = regress_json(result);
  write_file(results.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n", folder + "/results.json");
  write_file(regress_page(results, pictures), folder + "/index.html");
}

/// Rows as they come, and on a terminal one line below them that says how long it will take.
class Display {
 public:
  Display(const RegressOptions& options, std::size_t width) : json_(options.json), width_(width), bar_(isatty(STDERR_FILENO)) {
    show(regress_head(width_));
  }

  void run(const RegressProgress& p) const {
    if (bar_) log("\r{:3.0f} %, {:.0f} s done, {:.0f} s left ", 100 * p.fraction, p.seconds, p.remaining);
  }
  void row(const CaseResult& result, const RegressProgress& p) const {
    if (bar_) log("\r{:40}\r", "");
    show(regress_row(result, width_));
    if (!bar_) log("{}: {} ({:.0f} %, {:.0f} s left)\n", result.name, name_of(result.status), 100 * p.fraction, p.remaining);
  }
  void end(const SuiteResult& result) const { show("\n" + regress_summary(result) + "\n"); }

 private:
  void show(const std::string& text) const {
    if (!json_) print_now(text);
  }

  bool json_;
  std::size_t width_;
  bool bar_;
};

/// 4 when a reference could not be written, else 5 when a picture differs, else 7 when a case could not be judged.
int exit_code_of(const SuiteResult& result) {
  if (stop_requested()) return stop_exit_code();
  if (std::any_of(result.cases.begin(), result.cases.end(), [](const CaseResult& c) { return c.unwritten; }))
    return static_cast<int>(Failure::output);
  if (result.count(CaseStatus::fail) > 0) return static_cast<int>(Failure::differs);
  const std::size_t unjudged = result.count(CaseStatus::crash) + result.count(CaseStatus::timeout) +
                               result.count(CaseStatus::error) + result.count(CaseStatus::stopped);
  return unjudged > 0 ? static_cast<int>(Failure::incomplete) : 0;
}

/// Before anything is rendered: what is rendered for nothing has taken minutes.
void require_writable(const RegressOptions& options, const std::string& suite) {
  if (!options.report.empty()) make_folder(options.report);
  if (!options.junit.empty()) check_writable(options.junit, "--junit");
  if (options.settings.update && access(suite.c_str(), W_OK) != 0)
    throw Error(Failure::output, suite + ": folder is not writable; --update puts the references there");
}

int run_regress(RegressOptions options) {
  const RegressSuite suite = read_suite(options.suite);
  require_writable(options, suite.folder);
  const ScratchFolder scratch;
  options.settings.work_folder = scratch.path();
  options.settings.program = own_path();
  options.settings.max_memory = memory_limit(options.max_memory);
  catch_stop_signals("stopping; what is complete is reported; press again to quit at once\n");

  const Display display(options, longest_name(suite));
  const SuiteResult result = run_suite(suite, options.settings,
                                       {.case_done = [&](const CaseResult& c, const RegressProgress& p) { display.row(c, p); },
                                        .run_done = [&](const RegressProgress& p) { display.run(p); },
                                        .stop = &stop_requested()});
  display.end(result);
  if (options.json) print("{}\n", regress_json(result).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  if (!options.report.empty()) save_report(options.report, [&](const std::string& folder) { write_report(result, folder); });
  if (!options.junit.empty()) write_file(regress_junit(result), options.junit);
  return exit_code_of(result);
}

}  // namespace

void add_regress(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("regress", "hold a suite of scenes against its references, statistically");
  auto options = std::make_shared<RegressOptions>();
  RegressSettings& s = options->settings;
  command->footer(
      "Exit codes: 0 all agree, 5 a picture differs, 7 a case could not be judged (no or another reference, settings that\n"
      "cannot be read, a render that fails, crashes or takes too long), 2 usage, 3 no suite, 4 something cannot be written,\n"
      "130/143 interrupted: what was judged by then is in the report.");
  command->add_option("suite", options->suite, "folder of scenes, each with settings NAME.json and a reference NAME.exr")
      ->required();
  command->add_option("-o,--output", options->report,
                      "folder for the report: index.html, results.json, renders [none]; -o regress-report");
  command->add_option("--filter", s.filter, "cases to run: part of a name, or a glob [all]; --filter 'medium_*'");
  command->add_option("--seed", s.seed, "of the random numbers; another one must pass as well [0]; --seed 7")
      ->check(whole_number(0, std::uint64_t{1} << 40));
  command->add_flag("--update", s.update, "render the references anew, say what changed, and replace them");
  command->add_option("--jobs,--threads", s.jobs, "renders side by side, of one thread each [0: one a core]; --jobs 2")
      ->check(whole_number(0, kMostThreads));
  command
      ->add_option("--max-memory", options->max_memory,
                   "GB for all renders at a time: each gets its share, and a case that is estimated to need more is an error "
                   "[what the machine, or a container's limit, allows]; --max-memory 8")
      ->check(positive());
  command->add_option("--level", s.family_level, "chance of a false alarm in a run of the whole suite [0.001]; --level 0.01")
      ->check(number_between(1e-12, 0.5));
  command->add_option("--junit", options->junit, "JUnit XML to write, for CI [none]; --junit regress.xml");
  command->add_flag("--json", options->json, "results as JSON on stdout instead of the table");
  command->callback([options, &exit_code] { exit_code = run_regress(*options); });
}

}  // namespace tyndall::cli
