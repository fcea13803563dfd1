#include "cli/checkpoint_file.h"

#include <fmt/core.h>

#include <filesystem>

#include "cli/log.h"
#include "io/atomic_file.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {

bool CheckpointFile::resume(RenderJob& job, int most_samples) const {
  std::error_code code;
  if (!std::filesystem::exists(path_, code)) return false;
  job.restore(read_file(path_), path_);
  if (job.samples() > most_samples) {
    throw Error(Failure::scene, fmt::format("{}: holds {} samples a pixel, more than the {} asked for; give --spp {} or more, or remove "
                                            "it, or leave out --resume, to begin anew",
                                            path_, job.samples(), most_samples, job.samples()));
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
