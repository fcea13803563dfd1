/// What the scripts of engines that run a shell have in common.
#pragma once

#include <string>

#include "farm/farm_job.h"

namespace tyndall {

/// Sets what the templates name, then becomes the command. `task`: where the shell finds the task's number, from 1.
std::string shell_body(const FarmJob& job, const FarmStep& step, const std::string& task);

}  // namespace tyndall
