#include "cli/merge_inputs.h"

#include <algorithm>
#include <filesystem>

#include "tyndall/deep_image.h"
#include "tyndall/error.h"

namespace tyndall::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> images_in(const std::string& folder, const std::string& output) {
  std::vector<std::string> images;
  std::error_code problem, ignored;
  for (fs::directory_iterator file(folder, problem), end; !problem && file != end; file.increment(problem)) {
    const fs::path& path = file->path();
    const bool hidden = path.filename().string().starts_with(".");  // being written
    if (path.extension() != ".exr" || hidden || fs::equivalent(path, output, ignored)) continue;
    if (!is_deep_exr(path.string())) images.push_back(path.string());
  }
  if (problem) throw Error(Failure::scene, folder + ": cannot be read: " + problem.message());
  std::sort(images.begin(), images.end());
  return images;
}

std::int64_t state_of(const std::string& path) {
  std::error_code absent;
  const auto time = fs::last_write_time(path, absent);
  if (absent) return -1;
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(time.time_since_epoch().count()) >> 1);
}

}  // namespace

bool MergeInputs::any_there() const {
  return std::any_of(states.begin(), states.end(), [](std::int64_t state) { return state >= 0; });
}

MergeInputs merge_inputs(const std::vector<std::string>& names, const std::string& output) {
  MergeInputs inputs;
  for (const std::string& name : names) {
    std::error_code absent;
    if (fs::is_directory(name, absent)) {
      const auto images = images_in(name, output);
      inputs.paths.insert(inputs.paths.end(), images.begin(), images.end());
    } else {
      inputs.paths.push_back(name);
    }
  }
  for (const std::string& path : inputs.paths) inputs.states.push_back(state_of(path));
  return inputs;
}

}  // namespace tyndall::cli
