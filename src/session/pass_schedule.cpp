#include "session/pass_schedule.h"

#include <algorithm>
#include <bit>

#include "session/sample_plan.h"

namespace tyndall {
namespace {

constexpr int kLargestPass = 16;
constexpr double kPassSeconds = 1.0;  ///< aim: the longest wait for a stop
constexpr double kReportSeconds = 0.2;
constexpr int kFirstErrorCheck = 64;  ///< samples; replicates of fewer are too noisy to decide on

int samples_to_next_checkpoint(int samples) {
  const unsigned next = std::bit_ceil(static_cast<unsigned>(samples) + 1);
  return static_cast<int>(next) - samples;
}

/// Between looks at the error of an adaptive render, which has as many samples.
int error_check_step(int samples) {
  return std::max(static_cast<int>(std::bit_floor(static_cast<unsigned>(samples))) / 8, SamplePlan::kPilot / 4);
}

}  // namespace

bool PassSchedule::is_error_check(int samples) const {
  if (!until_error_) return false;
  if (!adaptive_) return samples >= kFirstErrorCheck && is_checkpoint(samples);
  return samples >= SamplePlan::kPilot && samples % error_check_step(samples) == 0;
}

/// By which factor the errors are above those that were asked for, the worse of both.
double PassSchedule::excess(const RenderJob& job) const {
  const RenderReport report = job.report();
  const double of_mean = settings_.error ? report.estimated_relmse / *settings_.error : 0;
  const double of_worst = settings_.error_max ? report.worst_relmse / *settings_.error_max : 0;
  return std::max(of_mean, of_worst);
}

bool PassSchedule::complete(const RenderJob& job) const {
  if (job.samples() >= samples_wanted_) return true;
  if (settings_.time && job.samples() > 0 && job.seconds() >= *settings_.time) return true;
  return is_error_check(job.samples()) && excess(job) < 1;
}

int PassSchedule::next_pass(const RenderJob& job) {
  pass_timer_ = {};
  if (!begun_) begun_ = Begun{pass_timer_, job.samples(), job.seconds()};
  if (complete(job)) return 0;
  const int done = job.samples();
  int pass = std::clamp(done, 1, kLargestPass);
  if (done > 0) {
    const double a_sample = job.seconds() / done;
    double budget = kPassSeconds;
    if (settings_.time) budget = std::min(budget, *settings_.time - job.seconds());
    pass = std::clamp(static_cast<int>(budget / std::max(a_sample, 1e-9)), 1, pass);
  }
  if (settings_.slice) pass = std::max(pass / 2 * 2, 2);  // replicates of as many samples in each
  if (checkpoints_ || until_error_) pass = std::min(pass, samples_to_next_checkpoint(done));
  if (until_error_ && adaptive_) pass = std::min(pass, error_check_step(done) - done % error_check_step(done));
  // The error falls like 1/samples: good enough to tell how long it will take.
  if (until_error_ && done >= 2 && is_checkpoint(done)) samples_needed_ = done * excess(job);
  return std::min(pass, samples_wanted_ - done);
}

double PassSchedule::fraction(double samples, double seconds) const {
  double fraction = samples / samples_wanted_;
  if (settings_.time) fraction = std::max(fraction, seconds / *settings_.time);
  if (samples_needed_ > 0)
    fraction =
        std::max(fraction, samples / std::max<double>(samples_needed_, adaptive_ ? SamplePlan::kPilot : kFirstErrorCheck));
  return std::min(fraction, 1.0);
}

std::optional<Progress> PassSchedule::progress(const RenderJob& job, double pass_samples) {
  const double now = begun_ ? begun_->timer.seconds() : 0;
  if (!begun_ || (now - last_report_ < kReportSeconds && job.samples() < samples_wanted_)) return std::nullopt;
  last_report_ = now;
  Progress p;
  p.samples_done = job.samples();
  p.preparing = job.samples() == 0 && pass_samples == 0;
  p.seconds = now;
  // The job's clock stands still until a pass has ended.
  p.fraction = fraction(p.samples_done + pass_samples, job.seconds() + (pass_samples > 0 ? pass_timer_.seconds() : 0));
  const double here = p.fraction - fraction(begun_->samples, begun_->seconds);  // what a checkpoint restored took no time here
  p.remaining = here > 0 ? now * (1 - p.fraction) / here : 0.0;
  return p;
}

}  // namespace tyndall
