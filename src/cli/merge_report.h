/// What merging found, in words: how many slices came, how good the picture is, and what to do next.
#pragma once

#include <optional>
#include <string>

#include "report/merge.h"

namespace tyndall::cli {

/// Lines for the log. `wanted`: a relMSE to be reached.
std::string as_text(const Merged& merged, std::optional<double> wanted);

}  // namespace tyndall::cli
