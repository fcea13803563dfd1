/// How far the slices of a render have come, from the files in their folder alone.
#pragma once

#include <string>
#include <vector>

#include "tyndall/slice.h"

namespace tyndall {

enum class SliceState {
  missing,  ///< no file of it
  lost,     ///< its checkpoint, or what a stop left of it, is old
  running,  ///< its checkpoint is fresh
  there     ///< complete
};

struct SliceStatus {
  SliceState state = SliceState::missing;
  int samples = 0, share = 0;  ///< a pixel: done, and asked for
  double seconds = 0;          ///< of rendering, as far as known
  double age = 0;              ///< seconds since its file was written
  std::string path;            ///< of its image; empty: none yet
};

struct FolderStatus {
  int total = 0;  ///< samples a pixel of all slices
  bool timed = false;
  std::vector<SliceStatus> slices;      ///< by number
  std::vector<std::string> unreadable;  ///< why, for files that are damaged
};

/// `lost_after`: seconds without a new checkpoint. Throws Error (scene) for a folder that cannot be read, that holds no slice,
/// or slices of renders cut differently.
FolderStatus folder_status(const std::string& folder, double lost_after);

/// Seconds of rendering that `slice` still takes, at its own rate or else the mean of all; 0 where nothing is known, and for
/// slices that end by time.
double seconds_left(const FolderStatus& status, const SliceStatus& slice);

}  // namespace tyndall
