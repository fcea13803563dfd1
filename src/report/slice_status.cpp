#include "report/slice_status.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "report/slice.h"
#include "tyndall/deep_image.h"
#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

double age_of(const fs::path& path) {
  std::error_code gone;
  const auto time = fs::last_write_time(path, gone);
  if (gone) return 0;
  return std::chrono::duration<double>(fs::file_time_type::clock::now() - time).count();
}

std::vector<fs::path> files_in(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code problem;
  for (fs::directory_iterator file(folder, problem), end; !problem && file != end; file.increment(problem)) {
    if (!file->path().filename().string().starts_with(".")) files.push_back(file->path());
  }
  if (problem) throw Error(Failure::scene, folder + ": cannot be read: " + problem.message());
  std::sort(files.begin(), files.end());
  return files;
}

/// Gathers what the files say, the better news first.
class Survey {
 public:
  explicit Survey(double lost_after) : lost_after_(lost_after) {}

  void look_at(const fs::path& path) {
    try {
      if (path.extension() == ".exr") look_at_image(path);
      if (path.extension() == ".checkpoint") look_at_checkpoint(path);
    } catch (const Error& e) {
      status_.unreadable.emplace_back(e.what());
    }
  }
  FolderStatus take() { return std::move(status_); }

 private:
  void look_at_image(const fs::path& path) {
    if (is_deep_exr(path.string())) return;  // stands beside its flat image
    const Image header = read_exr_header(path.string());
    const auto info = slice_info(header, path.string());
    if (!info) return;
    const auto render = render_of(header, info);
    if (!render_) render_ = render;
    if (render != render_) refuse(path, *info);
    const double* seconds = header.attribute<double>(attributes::kRenderTime);
    note(*info, info->complete() ? SliceState::there : SliceState::lost, seconds ? *seconds : 0, path).path = path.string();
  }

  void look_at_checkpoint(const fs::path& path) {
    const auto checkpoint = slice_checkpoint(read_file(path.string()), path.string());
    if (!checkpoint) return;
    note(checkpoint->info, age_of(path) < lost_after_ ? SliceState::running : SliceState::lost, checkpoint->seconds, path);
  }

  [[noreturn]] static void refuse(const fs::path& path, const SliceInfo& info) {
    throw Error(Failure::scene, path.string() + ": is a slice of another render, " + std::to_string(info.choice.count) +
                                    " of " + std::to_string(info.total) +
                                    " samples and of a scene, seed and options of its own; keep it in a folder of its own");
  }

  SliceStatus& note(const SliceInfo& info, SliceState state, double seconds, const fs::path& path) {
    if (status_.slices.empty()) {
      status_.slices.resize(static_cast<std::size_t>(info.choice.count));
      status_.total = info.total;
      status_.timed = info.timed;
    }
    if (info.choice.count != static_cast<int>(status_.slices.size()) || info.total != status_.total) refuse(path, info);
    SliceStatus& slice = status_.slices[static_cast<std::size_t>(info.choice.index) - 1];
    const bool news = state > slice.state || (state == slice.state && info.range.count > slice.samples);
    slice.share = info.share().count;
    if (!news) return slice;
    slice.state = state;
    slice.samples = info.range.count;
    slice.seconds = seconds;
    slice.age = age_of(path);
    return slice;
  }

  double lost_after_;
  std::optional<std::string> render_;  ///< of the first slice
  FolderStatus status_;
};

}  // namespace

FolderStatus folder_status(const std::string& folder, double lost_after) {
  Survey survey(lost_after);
  for (const fs::path& path : files_in(folder)) survey.look_at(path);
  FolderStatus status = survey.take();
  if (status.slices.empty()) {
    throw Error(Failure::scene, status.unreadable.empty()
                                    ? folder + ": holds no slice and no checkpoint of one; render with --slice into it"
                                    : status.unreadable.front());
  }
  const int count = static_cast<int>(status.slices.size());
  for (int i = 1; i <= count; ++i)
    status.slices[static_cast<std::size_t>(i) - 1].share = SliceInfo{{i, count}, status.total, false, false, {}}.share().count;
  return status;
}

double seconds_left(const FolderStatus& status, const SliceStatus& slice) {
  if (status.timed || slice.samples >= slice.share) return 0;
  double seconds = slice.seconds;
  std::int64_t samples = slice.samples;
  if (!(seconds > 0)) {
    samples = 0;
    for (const SliceStatus& other : status.slices) {
      if (!(other.seconds > 0)) continue;
      seconds += other.seconds;
      samples += other.samples;
    }
  }
  return samples > 0 ? seconds / static_cast<double>(samples) * (slice.share - slice.samples) : 0;
}

}  // namespace tyndall
