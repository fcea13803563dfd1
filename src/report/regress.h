/// Renders the cases of a suite in processes of their own and holds them against their references.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report/regress_judge.h"
#include "report/regress_suite.h"
#include "tyndall/image.h"

namespace tyndall {

struct RegressSettings {
  std::string program;         ///< path of the tyndall that renders
  std::string work_folder;     ///< takes the runs and what they print; must exist
  std::string filter;          ///< see select_cases
  std::uint64_t seed = 0;      ///< another one gives other noise
  bool update = false;         ///< render the references instead
  int jobs = 0;                ///< renders side by side, of one thread each; 0: one a core
  std::size_t max_memory = 0;  ///< bytes, shared by these renders; 0: no limit
  double family_level = 1e-3;  ///< chance that a whole suite without a fault raises an alarm
};

enum class CaseStatus { pass, fail, crash, timeout, error, updated, fresh, stopped };
/// As in results.json: "pass", "fail" ...; a fresh reference is "new".
std::string name_of(CaseStatus status);

struct CaseResult {
  std::string name;
  CaseStatus status = CaseStatus::stopped;
  double seconds = 0;     ///< of all its runs
  int samples = 0;        ///< a pixel, of all its runs
  std::string message{};  ///< one line
  std::vector<LayerTest> tests{};
  bool unwritten = false;                      ///< an error, for the new reference could not be written
  std::optional<Image> render{}, reference{};  ///< with variances; reference: as it was before an update
};

struct SuiteResult {
  std::string suite;
  std::uint64_t seed = 0;
  int jobs = 0;  ///< renders side by side; 0: one a core
  double seconds = 0, family_level = 0;
  std::vector<CaseResult> cases;  ///< by name

  std::size_t count(CaseStatus status) const;
};

struct RegressProgress {
  double fraction = 0, seconds = 0, remaining = 0;
};

struct RegressControl {
  std::function<void(const CaseResult&, const RegressProgress&)> case_done;  ///< may be empty
  std::function<void(const RegressProgress&)> run_done;                      ///< may be empty
  const std::atomic<bool>* stop = nullptr;                                   ///< set it to end soon
};

/// A case that cannot be rendered or judged is a result, not an exception. Throws Error for a filter that matches
/// nothing and when no process can be made.
SuiteResult run_suite(const RegressSuite& suite, const RegressSettings& settings, const RegressControl& control = {});

}  // namespace tyndall
