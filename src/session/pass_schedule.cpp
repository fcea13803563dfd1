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
  return std::max(static_cast<int>(std::bit_floor(static_cast<unsigned>(samples))) / 8, SamplePlan::kStep);
}

}  // namespace

bool PassSchedule::is_error_check(int samples) const {
  if (!until_error_) return false;
  if (!adaptive_) return samples >= kFirstErrorCheck && is_checkpoint(samples);
  return samples >= SamplePlan::kLeast && samples % error_check_step(samples) == 0;
}

/// By which factor the errors are above those that were asked for, the worse of both.
double PassSchedule::excess(const RenderReport& report) const {
  const double of_mean = settings_.error ? report.estimated_relmse / *settings_.error : 0;
  const double of_worst = settings_.error_max ? report.worst_relmse / *settings_.error_max : 0;
  return std::max(of_mean, of_worst);
}

bool PassSchedule::is_good_enough(const RenderReport& report) const {
  return excess(report) < 1 && (!adaptive_ || report.least_samples >= SamplePlan::kLeast);
}

/// Or nearer than the end of the next step, where a render goes on in such.
bool PassSchedule::is_time_up(const RenderJob& job) const {
  const double half_a_step = adaptive_ && job.samples() >= SamplePlan::kStep ? 0.5 * SamplePlan::kStep : 0.0;
  return job.seconds() * (1 + half_a_step / job.samples()) >= *settings_.time;
}

bool PassSchedule::complete(const RenderJob& job) const {
  if (job.samples() >= samples_wanted_) return true;
  if (settings_.time && job.samples() > 0 && is_time_up(job)) return true;
  return is_error_check(job.samples()) && is_good_enough(job.report());
}

int PassSchedule::next_pass(const RenderJob& job) {
  pass_ = Begun{{}, job.samples(), job.seconds(), job.preparing_seconds()};
  if (!begun_) begun_ = pass_;
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
  if (until_error_ && done >= 2 && is_checkpoint(done)) samples_needed_ = done * excess(job.report());
  return std::min(pass, samples_wanted_ - done);
}

/// Of the samples that end the render, as far as is known how many these are.
double PassSchedule::share(double samples) const {
  double share = samples_wanted_ <= kMostSamples ? samples / samples_wanted_ : 0.0;
  if (samples_needed_ > 0)
    share = std::max(share, samples / std::max<double>(samples_needed_, adaptive_ ? SamplePlan::kLeast : kFirstErrorCheck));
  return std::min(share, 1.0);
}

double PassSchedule::fraction(double samples, double seconds) const {
  if (!settings_.time) return share(samples);
  // A time that is up does not end the first sample.
  return std::max(share(samples), std::min(seconds / *settings_.time, samples < 1 ? samples : 1.0));
}

/// Samples are reckoned to go on as they did, which took `working` seconds: looking at the film, and at what pays, is not done
/// again.
double PassSchedule::remaining(double samples, double seconds, double working) const {
  const double done = share(samples), here = done - share(begun_->samples);  // what a checkpoint restored took no time here
  double left = here > 0 ? working * (1 - done) / here : kInfinity;
  if (settings_.time) {
    const double first_sample = samples > 0 && samples < 1 ? working * (1 - samples) / samples : 0.0;
    left = std::min(left, std::max(*settings_.time - seconds, first_sample));
  }
  return left < kInfinity ? left : 0.0;
}

std::optional<Progress> PassSchedule::progress(const RenderJob& job, double pass_samples) {
  const double now = begun_ ? begun_->timer.seconds() : 0;
  if (!begun_ || (now - last_report_ < kReportSeconds && job.samples() < samples_wanted_)) return std::nullopt;
  last_report_ = now;
  Progress p;
  p.samples_done = job.samples();
  p.preparing = job.samples() == 0 && pass_samples == 0;
  p.seconds = now;
  // The job's clock stands still until a pass has ended, and so do its samples, but for those before a pilot in its midst.
  const double samples = std::max<double>(p.samples_done, pass_->samples + pass_samples);
  const double seconds = std::max(job.seconds(), pass_->seconds + pass_->timer.seconds());
  const bool prepares = pass_samples == 0 && p.samples_done == pass_->samples;
  const double prepared = prepares ? pass_->preparing + pass_->timer.seconds() : job.preparing_seconds();
  p.fraction = fraction(samples, seconds);
  p.remaining = remaining(samples, seconds, now - (prepared - begun_->preparing));
  return p;
}

}  // namespace tyndall
