#include "cli/checkpoint_file.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>

#include "cli/log.h"
#include "io/atomic_file.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {

bool CheckpointFile::resume(RenderJob& job, const RenderSettings& limits) const {
  std::error_code code;
  if (!std::filesystem::exists(path_, code)) return false;
  job.restore(read_file(path_), path_);
  const auto refuse = [&](const std::string& holds, const std::string& give) {
    throw Error(Failure::scene,
                fmt::format("{}: holds {}; give {}, or remove it, or leave out --resume, to begin anew", path_, holds, give));
  };
  const int wanted = sample_range(limits).count;
  if (job.samples() > wanted) {
    refuse(fmt::format("{} samples a pixel, more than the {} asked for", job.samples(), wanted),
           fmt::format("--spp {} or more", job.samples()));
  }
  // The time counts from the beginning of the unbroken render. One that was cut off after its last pass holds a little more
  // than it was given, and is complete; more than that is another wish than the checkpoint's.
  const double a_sample = job.seconds() / job.samples();
  if (limits.time && job.seconds() > *limits.time + 1 + 2 * a_sample) {
    refuse(fmt::format("{:.1f} seconds of rendering, more than the {} asked for", job.seconds(), *limits.time),
           fmt::format("--time {:.0f} or more", std::ceil(job.seconds())));
  }
  return true;
}

void CheckpointFile::save(const RenderJob& job) {
  try {
    write_file(job.save(), path_);
    failure_.clear();
  } catch (const std::exception& e) {
    if (failure_ != e.what()) log("warning: {}; the render goes on, and the last checkpoint stays\n", e.what());
    failure_ = e.what();
  }
}

void CheckpointFile::remove() const {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void CheckpointFile::tidy() const {
  remove_abandoned_files(path_);
  remove_abandoned_files(output_);
}

}  // namespace tyndall::cli
