/// Several renders of one scene run against each other: the measuring half of `compare`.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report/metrics.h"
#include "tyndall/render.h"

namespace tyndall {

/// What every run may spend. One of the two is set.
struct RaceBudget {
  std::optional<double> seconds;  ///< of rendering
  std::optional<int> samples;     ///< a pixel
};

/// A run at one moment.
struct RaceCheckpoint {
  double seconds = 0;
  int samples = 0;
  ErrorMetrics error;
};

/// One method, one seed.
struct RaceRun {
  std::vector<RaceCheckpoint> checkpoints;  ///< at 1, 2, 4, 8 ... samples and at the end
  Image image;                              ///< at the end
  std::array<double, 3> mean_rgb{};         ///< of it
  /// With RaceControl::filter: the same of the filtered pictures, from 2 samples on; seconds include one filtering.
  std::vector<RaceCheckpoint> filtered;
  Image filtered_image;
  RenderReport report;
  bool given_up = false;  ///< its first sample alone took several times the budget: no checkpoints, no image
};

struct RaceControl {
  /// Error of a picture against the reference. Not on the clock.
  std::function<ErrorMetrics(const Image&)> measure;
  /// What is made of a picture after rendering, to be measured as well; may be empty. Not on the clock of the race.
  std::function<Image(const Image&)> filter{};
  /// Told the fraction of the race that is run; may be empty.
  std::function<void(double)> progress{};
  const std::atomic<bool>* stop = nullptr;  ///< set it to end the race at once; nothing of it is then of use
};

/// Of R, G and B.
std::array<double, 3> mean_color(const Image& image);

/// One run for each of `methods` on `world`, turn by turn in short passes, so that a machine that slows down slows all
/// alike. Empty when stopped. Each method's clock runs while its own pass does. `spp`, `time`, `error` and `error_max` of
/// the methods are not looked at.
std::vector<RaceRun> race(const World& world, const std::vector<RenderSettings>& methods, const RaceBudget& budget,
                          const RaceControl& control);

}  // namespace tyndall
