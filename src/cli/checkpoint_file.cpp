#include "cli/checkpoint_file.h"

#include <filesystem>

#include "cli/log.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {

bool CheckpointFile::resume(RenderJob& job) const {
  std::error_code code;
  if (!std::filesystem::exists(path_, code)) return false;
  job.restore(read_file(path_), path_);
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

}  // namespace tyndall::cli
