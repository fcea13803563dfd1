/// The files that are to be merged, as they stand now.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tyndall::cli {

struct MergeInputs {
  std::vector<std::string> paths;
  std::vector<std::int64_t> states;  ///< of each: a number that changes when it does; negative: there is none

  bool any_there() const;
  bool operator==(const MergeInputs&) const = default;
};

/// `names` with each folder replaced by the .exr files in it, by name, but for `output`.
MergeInputs merge_inputs(const std::vector<std::string>& names, const std::string& output);

}  // namespace tyndall::cli
