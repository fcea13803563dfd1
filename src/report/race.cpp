#include "report/race.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include "tyndall/timer.h"

namespace tyndall {
namespace {

constexpr double kTurnSeconds =
    0.25;                        ///< aim for one turn: short against the drift of a machine, long against a pass's overhead
constexpr double kPatience = 4;  ///< budgets that a first sample may take

}  // namespace

std::array<double, 3> mean_color(const Image& image) {
  std::array<double, 3> mean{};
  for (int k = 0; k < 3; ++k) {
    const std::vector<float>& values = image.find(std::string(1, "RGB"[k]))->values;
    mean[k] = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }
  return mean;
}

namespace {

bool stopped(const RaceControl& control) { return control.stop != nullptr && control.stop->load(std::memory_order_relaxed); }

/// The race's budget alone ends a run, also of one pixel.
RenderSettings without_ends(RenderSettings settings) {
  settings.spp = std::numeric_limits<int>::max();
  settings.time.reset();
  settings.error.reset();
  settings.error_max.reset();
  return settings;
}

class Runner {
 public:
  Runner(const World& world, const RenderSettings& settings, const RaceBudget& budget)
      : job_(world, without_ends(settings)), budget_(budget) {}

  bool done() const { return run_.given_up || samples_left() == 0; }

  void turn(const RaceControl& control) {
    const int samples = next_pass();
    const bool first = job_.samples() == 0;
    pass_timer_ = {};
    const auto go_on = [&](double samples_done) {
      const double rendering = pass_timer_.seconds() - job_.preparing_seconds();
      const bool patient = !first || samples_done == 0 || !budget_.seconds || rendering < kPatience * *budget_.seconds;
      return patient && !stopped(control);
    };
    if (!job_.advance(samples, go_on)) {
      run_.given_up = true;
      return;
    }
    const int done = job_.samples();
    if (std::has_single_bit(static_cast<unsigned>(done)) || samples_left() == 0) add_checkpoint(control);
  }

  double fraction() const {
    if (done()) return 1;
    if (budget_.seconds) return std::min(1.0, job_.seconds() / *budget_.seconds);
    return static_cast<double>(job_.samples()) / *budget_.samples;
  }

  RaceRun finish() {
    run_.report = job_.report();
    if (!run_.given_up) {
      run_.image = job_.image();
      run_.mean_rgb = mean_color(run_.image);
    }
    return std::move(run_);
  }

 private:
  void add_checkpoint(const RaceControl& control) {
    const Image image = job_.image();
    const int done = job_.samples();
    run_.checkpoints.push_back({job_.seconds(), done, control.measure(image)});
    if (!control.filter || done < 2) return;
    const Timer filtering;
    run_.filtered_image = control.filter(image);
    const double seconds = job_.seconds() + filtering.seconds();
    run_.filtered.push_back({seconds, done, control.measure(run_.filtered_image)});
  }

  double a_sample() const { return (job_.seconds() - job_.preparing_seconds()) / job_.samples(); }

  /// Samples that the budget still holds, to the nearest whole one.
  int samples_left() const {
    const int done = job_.samples();
    if (budget_.samples) return *budget_.samples - done;
    if (done == 0) return 1;
    const double left = (*budget_.seconds - job_.seconds()) / a_sample();
    return static_cast<int>(std::clamp(left + 0.5, 0.0, 1e9));
  }

  int next_pass() const {
    const int done = job_.samples();
    if (done == 0) return 1;
    const int to_checkpoint = static_cast<int>(std::bit_ceil(static_cast<unsigned>(done) + 1)) - done;
    const int a_turn = static_cast<int>(std::clamp(kTurnSeconds / a_sample(), 1.0, 1e6));
    return std::min({a_turn, to_checkpoint, samples_left()});
  }

  RenderJob job_;
  RaceBudget budget_;
  RaceRun run_;
  Timer pass_timer_;
};

double mean_fraction(const std::vector<Runner>& runners) {
  double sum = 0;
  for (const Runner& r : runners) sum += r.fraction();
  return sum / static_cast<double>(runners.size());
}

}  // namespace

std::vector<RaceRun> race(const World& world, const std::vector<RenderSettings>& methods, const RaceBudget& budget,
                          const RaceControl& control) {
  std::vector<Runner> runners;
  for (const RenderSettings& m : methods) runners.emplace_back(world, m, budget);
  const auto running = [](const Runner& r) { return !r.done(); };
  // Who has come least far is next: all reach each point of the race at about the same time. One that has not begun may have
  // spent its time, as one has that is done.
  const auto is_behind = [](const Runner& a, const Runner& b) {
    return std::pair(a.done(), a.fraction()) < std::pair(b.done(), b.fraction());
  };
  while (std::any_of(runners.begin(), runners.end(), running)) {
    std::min_element(runners.begin(), runners.end(), is_behind)->turn(control);
    if (stopped(control)) return {};
    if (control.progress) control.progress(mean_fraction(runners));
  }
  std::vector<RaceRun> runs;
  for (Runner& r : runners) runs.push_back(r.finish());
  return runs;
}

}  // namespace tyndall
