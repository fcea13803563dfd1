// The loop around a RenderJob: how long it goes on, and who hears of it.
#include "render/pass_schedule.h"

namespace tyndall {
namespace {

class RenderLoop {
 public:
  RenderLoop(const World& world, const RenderSettings& settings, const RenderControl& control)
      : control_(control), job_(world, settings), schedule_(settings, static_cast<bool>(control.checkpoint)) {}

  Rendering run() {
    while (const int count = schedule_.next_pass(job_)) {
      job_.advance(count, [&](double samples) {
        report_progress(samples);
        return true;
      });
      report_progress(0);
      if (control_.checkpoint && PassSchedule::is_checkpoint(job_.samples())) control_.checkpoint(job_);
      if (stop_requested()) break;
    }
    RenderReport report = job_.report();
    report.stopped = stop_requested() && !schedule_.complete(job_);
    return {job_.image(), std::move(report)};
  }

 private:
  bool stop_requested() const { return control_.stop != nullptr && control_.stop->load(std::memory_order_relaxed); }

  /// `samples`: what every pixel has received of the running pass.
  void report_progress(double samples) {
    if (!control_.progress) return;
    if (const auto progress = schedule_.progress(job_, samples)) control_.progress(*progress);
  }

  const RenderControl& control_;
  RenderJob job_;
  PassSchedule schedule_;
};

}  // namespace

Rendering render(const World& world, const RenderSettings& settings, const RenderControl& control) {
  return RenderLoop(world, settings, control).run();
}

}  // namespace tyndall
