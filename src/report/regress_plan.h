/// The runs of a case: what is rendered, with which seed, and what became of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/child_process.h"
#include "report/regress.h"

namespace tyndall {

/// One render in a process of its own.
struct Run {
  std::size_t of_case = 0;  ///< index into RegressSuite::cases
  bool bytes = false;       ///< the one for byte equality
  std::string image;        ///< where it is written
  ChildCommand command;
  ChildResult result{};
};

/// Renders side by side: settings.jobs, or one a core.
int jobs_of(const RegressSettings& settings);

/// The runs of all chosen cases without a fault, those of a case in a row. Each may take its share of settings.max_memory.
std::vector<Run> plan_runs(const RegressSuite& suite, const RegressSettings& settings);

/// What is wrong with how a run ended; status pass when nothing is.
struct RunFault {
  CaseStatus status = CaseStatus::pass;
  std::string message;
};
RunFault fault_of(const Run& run);

/// Counts of the renderer that must be 0 in a correct render, summed over the runs of a case.
LayerTest health_of(const std::vector<const Run*>& runs);

}  // namespace tyndall
