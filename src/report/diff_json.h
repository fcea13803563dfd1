/// What a difference of two images is for programs.
#pragma once

#include <nlohmann/json.hpp>

#include "report/image_diff.h"

namespace tyndall {

nlohmann::ordered_json errors_json(const ErrorMetrics& errors);

/// What a denoised picture states of its errors (`stated` must be there), and how many times that the true ones are.
nlohmann::ordered_json stated_json(const ErrorMetrics& errors);

/// As `tyndall diff --json` prints it, but for the names of the files.
nlohmann::ordered_json diff_json(const ImageDiff& diff, const Judgement& judgement, const DiffSettings& settings);

}  // namespace tyndall
