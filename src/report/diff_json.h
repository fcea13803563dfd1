/// What a difference of two images is for programs.
#pragma once

#include <nlohmann/json.hpp>

#include "report/image_diff.h"

namespace tyndall {

/// As `tyndall diff --json` prints it, but for the names of the files.
nlohmann::ordered_json diff_json(const ImageDiff& diff, const Judgement& judgement, const DiffSettings& settings);

}  // namespace tyndall
