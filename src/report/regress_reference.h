/// Independent runs of one scene made one image, with a variance for every channel.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/statistics.h"
#include "tyndall/image.h"

namespace tyndall {

/// How many runs and samples stand behind an image; kept in its header.
struct RunCounts {
  int runs = 0;  ///< independent ones
  int spp = 0;   ///< samples a pixel of each
};

/// Gathers runs of equal samples and different seeds. The variance of a channel is the spread between them, so that it is
/// known for AOVs as well and needs no word from the renderer.
class RunMeans {
 public:
  /// Throws Error (usage) when the size or the channels differ from the first one's.
  void add(const Image& image);
  int count() const { return count_; }

  /// Mean and "Variance.<channel>" (of the mean) of every channel, and the counts in the header. Variances are rounded up
  /// to 9 bits, which is far more than they are known to and packs better. At least two runs.
  Image result(int spp) const;

 private:
  Image frame_;  ///< of the first one: bounds, colours, no channels
  std::vector<std::string> names_;
  std::vector<std::vector<Moments>> moments_;
  int count_ = 0;
};

/// Counts from the header of a RunMeans::result. Throws Error (scene) that names `path` when they are not there.
RunCounts run_counts(const Image& image, const std::string& path);

/// Whether the file is a RunMeans::result; not where it cannot be read.
bool is_reference(const std::string& path);

/// Removes what is tested by no statistics: "Variance.*" and "SampleCount" of a render.
bool is_tested_channel(const std::string& name);

}  // namespace tyndall
