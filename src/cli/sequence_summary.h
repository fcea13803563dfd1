/// The closing summary of a sequence, as text and as JSON.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/summary.h"

namespace tyndall::cli {

struct FrameSummary {
  int frame = 0;
  Summary summary;
};

struct SequenceSummary {
  std::string output;                ///< with a place for the frame
  std::size_t asked = 0;             ///< frames
  std::vector<FrameSummary> frames;  ///< that were rendered, as they came
  std::vector<int> there;            ///< frames that had been rendered before
  std::size_t builds = 0;            ///< of a whole scene
  std::size_t files_read = 0;        ///< and made to meshes, images and volumes, or hashed
  std::size_t files_kept = 0;        ///< times that this was not needed

  std::size_t missing() const { return asked - frames.size() - there.size(); }
};

std::string as_text(const SequenceSummary& summary);
std::string as_json(const SequenceSummary& summary);

}  // namespace tyndall::cli
