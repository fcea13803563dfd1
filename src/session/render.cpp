// The loop around a RenderJob: how long it goes on, and progress reports.

#include "session/pass_schedule.h"
#include "session/slice.h"
#include "tyndall/image_attributes.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

/// A pass that would last longer than this after a stop is given up.
constexpr double kLongestWait = 2;  // seconds

RenderSettings decided(RenderSettings settings) {
  settings.adaptive = is_adaptive(settings);
  return settings;
}

class RenderLoop {
 public:
  RenderLoop(const World& world, const RenderSettings& settings, const RenderControl& control)
      : control_(control), job_(world, decided(settings)), schedule_(settings, static_cast<bool>(control.checkpoint)) {}

  Rendering run() {
    if (control_.begin) control_.begin(job_);
    bool given_up = false;
    while (const int count = given_up ? 0 : schedule_.next_pass(job_)) {
      given_up = !run_pass(count);
      report_progress(0);
      if (!given_up && control_.checkpoint && PassSchedule::is_checkpoint(job_.samples())) control_.checkpoint(job_);
      if (!given_up && control_.pass_end) control_.pass_end(job_);
      if (stop_requested()) break;
      if (control_.save && since_save_.seconds() >= control_.save_seconds) save();
    }
    RenderReport report = job_.report();
    report.stopped = stop_requested() && (given_up || !schedule_.complete(job_));
    if (report.stopped && report.unrendered == 0 && control_.save) save();
    if (control_.end) control_.end(job_);
    Image image = job_.image();
    std::optional<DeepImage> deep = job_.deep_image();
    if (report.stopped) mark_stopped(image);
    if (report.stopped && deep) deep->attributes[attributes::kStopped] = 1;
    return {std::move(image), std::move(report), std::move(deep)};
  }

 private:
  /// False: it was given up. Being able to undo the pass costs memory, so it is left out where passes are short.
  bool run_pass(int count) {
    const Timer pass_timer;
    const bool first = job_.samples() == 0;
    const bool slow = first || job_.seconds() / job_.samples() * count > kLongestWait / 2;
    const auto watch = [&](double samples) {
      report_progress(samples);
      const bool may_end = slow || samples == 0;  // which is before it has begun: there is nothing to undo
      if (!may_end || !stop_requested()) return true;
      return pass_timer.seconds() * (count - samples) <= kLongestWait * samples;
    };
    return job_.advance(count, watch, slow ? RenderJob::GivenUp::undone : RenderJob::GivenUp::spoilt);
  }

  void save() {
    control_.save(job_);
    since_save_ = {};
  }

  bool stop_requested() const { return control_.stop != nullptr && control_.stop->load(std::memory_order_relaxed); }

  /// `samples`: what every pixel has received of the running pass.
  void report_progress(double samples) {
    if (!control_.progress) return;
    if (const auto progress = schedule_.progress(job_, samples)) control_.progress(*progress);
  }

  const RenderControl& control_;
  RenderJob job_;
  PassSchedule schedule_;
  Timer since_save_;
};

}  // namespace

Rendering render(const World& world, const RenderSettings& settings, const RenderControl& control) {
  return RenderLoop(world, settings, control).run();
}

}  // namespace tyndall
