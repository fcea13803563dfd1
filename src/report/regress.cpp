#include "report/regress.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

#include "report/regress_plan.h"
#include "report/regress_reference.h"
#include "report/shell_quote.h"
#include "report/statistics.h"
#include "tyndall/error.h"
#include "tyndall/io.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// The runs of one case.
struct Bunch {
  const RegressCase* about;
  std::vector<Run*> runs;
  std::size_t open = 0;  ///< not ended yet
  bool faulty = false;
};

std::string relative(double from, double to) {
  char text[64];
  std::snprintf(text, sizeof text, "%.5g -> %.5g (%+.2f %%)", from, to, from != 0 ? 100 * (to / from - 1) : 0.0);
  return text;
}

/// "differs in RGB, Albedo; bytes: the file is not ..."; the verdicts of layers are long, and stand in the report.
std::string failures_in(const std::vector<LayerTest>& tests) {
  std::string layers, others;
  for (const LayerTest& t : tests) {
    if (t.same) continue;
    if (t.blocks > 0) {
      layers += (layers.empty() ? "differs in " : ", ") + t.what;
    } else {
      others += "; " + t.what + ": " + t.verdict;
    }
  }
  return layers.empty() && !others.empty() ? others.substr(2) : layers + others;
}

bool same_bytes(const std::string& a, const std::string& b) {
  std::ifstream in_a(a, std::ios::binary), in_b(b, std::ios::binary);
  using Iterator = std::istreambuf_iterator<char>;
  return std::equal(Iterator(in_a), {}, Iterator(in_b), {});
}

/// Copied beside its place, then moved into it.
void put_file(const std::string& from, const std::string& to) {
  const std::string temporary = to + ".part";
  std::error_code problem;
  fs::copy_file(from, temporary, fs::copy_options::overwrite_existing, problem);
  if (!problem) fs::rename(temporary, to, problem);
  if (!problem) return;
  fs::remove(temporary, problem);
  throw Error(Failure::output, to + ": cannot be written; see that the suite's folder is writable and has room");
}

/// Layers that the references of a suite have; without one R G B, A and the AOVs that are asked for.
std::size_t layers_of_all(const RegressSuite& suite) {
  const auto of = [&](const RegressCase& c) {
    try {
      return layers_of(read_exr_header(suite.reference_path(c))).size();
    } catch (const Error&) {
      return 2 + c.aovs.size();
    }
  };
  std::size_t sum = 0;
  for (const RegressCase& c : suite.cases) sum += of(c);
  return sum;
}

/// Judges or blesses one case whose runs have all ended.
class Verdict {
 public:
  Verdict(const RegressSuite& suite, const RegressSettings& settings) : suite_(suite), settings_(settings) {
    layer_level_ = sidak(settings.family_level, static_cast<double>(layers_of_all(suite)));
  }

  CaseResult of(const Bunch& bunch) const {
    CaseResult result{.name = bunch.about->name};
    for (const Run* run : bunch.runs) result.seconds += run->result.seconds;
    if (take_fault(bunch, result)) return result;
    try {
      result.render = mean_of(bunch);
      result.samples = bunch.about->spp * run_counts(*result.render, "the render").runs;
      settings_.update ? bless(bunch, result) : test(bunch, result);
    } catch (const Error& e) {
      result.unwritten = e.failure() == Failure::output;
      result.status = CaseStatus::error;
      result.message = e.what();
    }
    return result;
  }

 private:
  /// The fault of the first run that has one; one that was skipped because of another's, or by a stop, comes last.
  static bool take_fault(const Bunch& bunch, CaseResult& result) {
    RunFault worst;
    for (const Run* run : bunch.runs) {
      const RunFault fault = fault_of(*run);
      const bool graver = worst.status == CaseStatus::pass || worst.status == CaseStatus::stopped;
      if (fault.status != CaseStatus::pass && graver) worst = fault;
    }
    result.status = worst.status;
    result.message = worst.message;
    return worst.status != CaseStatus::pass;
  }

  static Image mean_of(const Bunch& bunch) {
    RunMeans means;
    for (const Run* run : bunch.runs) {
      if (!run->bytes) means.add(read_image(run->image));
    }
    return means.result(bunch.about->spp);
  }

  static LayerTest health(const Bunch& bunch) { return health_of({bunch.runs.begin(), bunch.runs.end()}); }

  void test(const Bunch& bunch, CaseResult& result) const {
    const RegressCase& c = *bunch.about;
    const std::string path = suite_.reference_path(c);
    if (!fs::exists(path))
      throw Error(Failure::scene,
                  path + ": there is no reference yet; make one with --update --filter " + shell_quoted(c.name));
    result.reference = read_image(path);
    if (run_counts(*result.reference, path).spp != c.spp) {
      throw Error(Failure::scene, path + ": was made with another \"spp\" than " + std::to_string(c.spp) +
                                      "; renew it with --update --filter " + shell_quoted(c.name));
    }
    require_same_layers(*result.render, *result.reference, c);
    if (c.bytes && !fs::exists(suite_.bytes_path(c)))
      throw Error(Failure::scene,
                  suite_.bytes_path(c) + ": is missing; make it with --update --filter " + shell_quoted(c.name));
    result.tests = judge(*result.render, *result.reference, layer_level_);
    result.tests.push_back(health(bunch));
    if (c.bytes) result.tests.push_back(bytes_test(bunch));
    result.message = failures_in(result.tests);
    result.status = result.message.empty() ? CaseStatus::pass : CaseStatus::fail;
    if (result.message.empty()) result.message = result.tests.front().verdict;
  }

  /// A layer that one of them lacks cannot be judged.
  void require_same_layers(const Image& render, const Image& reference, const RegressCase& c) const {
    const auto names = [](const Image& image) {
      std::set<std::string> set;
      for (const Layer& layer : layers_of(image)) set.insert(layer.name);
      return set;
    };
    const std::set<std::string> rendered = names(render), stored = names(reference);
    const std::string path = suite_.reference_path(c), advice = "; renew it with --update --filter " + shell_quoted(c.name);
    for (const std::string& name : rendered) {
      if (!stored.contains(name)) throw Error(Failure::scene, path + ": lacks " + name + ", which is to be tested" + advice);
    }
    for (const std::string& name : stored) {
      if (!rendered.contains(name)) throw Error(Failure::scene, path + ": has " + name + ", which the render lacks" + advice);
    }
  }

  LayerTest bytes_test(const Bunch& bunch) const {
    const bool same = same_bytes(bunch.runs.back()->image, suite_.bytes_path(*bunch.about));
    return {.what = "bytes", .same = same, .verdict = same ? "" : "the file is not the stored one, byte for byte"};
  }

  void bless(const Bunch& bunch, CaseResult& result) const {
    const RegressCase& c = *bunch.about;
    const LayerTest healthy = health(bunch);
    if (!healthy.same) throw Error(Failure::run_time, "not blessed: " + healthy.verdict);
    result.status = CaseStatus::fresh;
    result.message = "first reference, " + std::to_string(result.samples) + " samples a pixel";
    if (fs::exists(suite_.reference_path(c))) tell_change(c, result);
    write_exr(*result.render, suite_.reference_path(c));
    if (c.bytes) put_file(bunch.runs.back()->image, suite_.bytes_path(c));
  }

  /// What the new reference does differently than the old one, if that can be read.
  void tell_change(const RegressCase& c, CaseResult& result) const {
    result.status = CaseStatus::updated;
    try {
      result.reference = read_image(suite_.reference_path(c));
      result.tests = judge(*result.render, *result.reference, layer_level_);
      result.message = "mean " + relative(layer_mean(*result.reference, layers_of(*result.reference).front()),
                                          layer_mean(*result.render, layers_of(*result.render).front()));
      const std::string failures = failures_in(result.tests);
      result.message += failures.empty() ? ", no difference seen" : ", " + failures;
    } catch (const Error& e) {
      result.reference.reset();
      result.message = std::string("the old one could not be compared: ") + e.what();
    }
  }

  const RegressSuite& suite_;
  const RegressSettings& settings_;
  double layer_level_;
};

RegressProgress progress(std::size_t done, std::size_t all, double seconds) {
  const double fraction = static_cast<double>(done) / static_cast<double>(all);
  return {fraction, seconds, done > 0 ? seconds * (1 - fraction) / fraction : 0};
}

/// A suite that is being run.
class SuiteRun {
 public:
  SuiteRun(const RegressSuite& suite, const RegressSettings& settings, const RegressControl& control)
      : control_(control), verdict_(suite, settings), runs_(plan_runs(suite, settings)) {
    for (Run& run : runs_) {
      const RegressCase* c = &suite.cases[run.of_case];
      if (bunches_.empty() || bunches_.back().about != c) bunches_.push_back({.about = c, .runs = {}});
      bunches_.back().runs.push_back(&run);
      ++bunches_.back().open;
      bunch_of_.push_back(bunches_.size() - 1);
    }
    result_ = {.suite = suite.folder,
               .seed = settings.seed,
               .jobs = settings.jobs,
               .family_level = settings.family_level,
               .cases = {}};
    for (const std::size_t i : select_cases(suite, settings.filter)) {
      const RegressCase& c = suite.cases[i];
      if (!c.fault.empty()) result_.cases.push_back({.name = c.name, .status = CaseStatus::error, .message = c.fault});
    }
  }

  SuiteResult finish(int jobs) {
    for (const CaseResult& faulty : result_.cases) {
      if (control_.case_done)
        control_.case_done(faulty, progress(0, std::max<std::size_t>(runs_.size(), 1), running_.seconds()));
    }
    std::vector<ChildCommand> commands;
    for (const Run& run : runs_) commands.push_back(run.command);
    run_children(commands, {.at_once = jobs,
                            .skip = [&](std::size_t i) { return bunches_[bunch_of_[i]].faulty; },
                            .done = [&](std::size_t i, const ChildResult& child) { run_ended(i, child); },
                            .stop = control_.stop});
    std::sort(result_.cases.begin(), result_.cases.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    result_.seconds = running_.seconds();
    return std::move(result_);
  }

 private:
  void run_ended(std::size_t i, const ChildResult& child) {
    Bunch& bunch = bunches_[bunch_of_[i]];
    runs_[i].result = child;
    bunch.faulty = bunch.faulty || fault_of(runs_[i]).status != CaseStatus::pass;
    const RegressProgress now = progress(++ended_, runs_.size(), running_.seconds());
    if (control_.run_done) control_.run_done(now);
    if (--bunch.open > 0) return;
    result_.cases.push_back(verdict_.of(bunch));
    if (control_.case_done) control_.case_done(result_.cases.back(), now);
  }

  const RegressControl& control_;
  Verdict verdict_;
  std::vector<Run> runs_;
  std::vector<Bunch> bunches_;         ///< of the runs of a case
  std::vector<std::size_t> bunch_of_;  ///< each run
  std::size_t ended_ = 0;
  SuiteResult result_;
  const Timer running_;
};

}  // namespace

std::string name_of(CaseStatus status) {
  switch (status) {
    case CaseStatus::pass:
      return "pass";
    case CaseStatus::fail:
      return "fail";
    case CaseStatus::crash:
      return "crash";
    case CaseStatus::timeout:
      return "timeout";
    case CaseStatus::error:
      return "error";
    case CaseStatus::updated:
      return "updated";
    case CaseStatus::fresh:
      return "new";
    case CaseStatus::stopped:
      break;
  }
  return "stopped";
}

std::size_t SuiteResult::count(CaseStatus status) const {
  return static_cast<std::size_t>(std::count_if(cases.begin(), cases.end(), [&](const auto& c) { return c.status == status; }));
}

SuiteResult run_suite(const RegressSuite& suite, const RegressSettings& settings, const RegressControl& control) {
  return SuiteRun(suite, settings, control).finish(jobs_of(settings));
}

}  // namespace tyndall
