#include "cli/farm_trial.h"

#include <fmt/core.h>

#include <algorithm>
#include <thread>

#include "cli/duration.h"
#include "cli/progress_display.h"
#include "cli/summary.h"
#include "tyndall/memory.h"
#include "tyndall/render.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

constexpr double kTrialSeconds = 5;
constexpr int kMostSamples = 64;
constexpr double kShareToBuild = 0.1;

/// A tenth of a second is not "0s".
std::string seconds_text(double seconds) { return seconds < 10 ? fmt::format("{:.2g}s", seconds) : duration(seconds); }

double share_to_build(const FarmTrial& trial, double render_seconds) {
  return trial.build_seconds / (trial.build_seconds + render_seconds);
}

}  // namespace

FarmTrial try_out(Scene scene, bool sanitize, double read_seconds, const std::string& progress) {
  const Timer build_timer;
  RenderSettings settings = scene.settings;
  const BuildSettings how{.lights = {settings.lights},
                          .volume_lights = settings.emission != EmissionStrategy::paths,
                          .sanitize = sanitize,
                          .threads = settings.threads,
                          .max_memory = usable_memory()};
  const World world = build(std::move(scene), how);
  FarmTrial trial{.build_seconds = read_seconds + build_timer.seconds(),
                  .threads = settings.threads > 0 ? settings.threads : static_cast<int>(std::thread::hardware_concurrency())};
  RenderJob job(world, settings);
  ProgressDisplay display(progress);
  display.begin("a trial");
  const int most = std::min(settings.spp, kMostSamples);
  const Timer timer;
  const auto watch = [&](double samples) {
    const double fraction = std::min(1.0, std::max((job.samples() + samples) / most, timer.seconds() / kTrialSeconds));
    display.show({.samples_done = job.samples(), .fraction = fraction, .seconds = timer.seconds(), .remaining = 0});
    return true;
  };
  while (job.samples() < most && job.seconds() < kTrialSeconds) job.advance(1, watch);
  display.finish();
  trial.build_seconds += job.preparing_seconds();
  trial.sample_seconds = (job.seconds() - job.preparing_seconds()) / job.samples();
  const Image image = job.image();  // counted as well
  trial.memory = peak_memory();
  return trial;
}

int most_slices(const FarmTrial& trial, int spp) {
  const double seconds = trial.sample_seconds * spp, least = trial.build_seconds * (1 - kShareToBuild) / kShareToBuild;
  return static_cast<int>(
      std::clamp(seconds / std::max(least, 1e-9), 1.0, static_cast<double>(std::max(spp / kSliceGrain, 1))));
}

std::string as_text(const FarmTrial& trial, const RenderSettings& settings, int slices) {
  const double render = settings.time ? *settings.time : trial.sample_seconds * settings.spp / slices;
  const double share = share_to_build(trial, render);
  std::string text = fmt::format("on this machine, {} threads: {} to read and build, {} a sample\n", trial.threads,
                                 seconds_text(trial.build_seconds), seconds_text(trial.sample_seconds));
  text += fmt::format("each of {} slices: {} to read and build, {} to render; {:.1f} % goes into building\n", slices,
                      seconds_text(trial.build_seconds), seconds_text(render), 100 * share);
  if (share <= kShareToBuild) return text;
  if (settings.time) {
    const double time = trial.build_seconds * (1 - kShareToBuild) / kShareToBuild;
    return text + fmt::format("better: --time {:.0f} or more, of which building is a tenth\n", std::max(time, 1.0));
  }
  return text + fmt::format("better: --slices {}, of which building is a tenth at most\n", most_slices(trial, settings.spp));
}

}  // namespace tyndall::cli
