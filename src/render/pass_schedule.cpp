#include "render/pass_schedule.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr int kLargestPass = 16;
constexpr double kPassSeconds = 1.0;    ///< aim: the longest wait for a stop
constexpr double kReportSeconds = 0.2;

}  // namespace

int PassSchedule::next_pass() const {
  const double elapsed = seconds();
  if (settings_.time && samples_done_ > 0 && elapsed >= *settings_.time) return 0;
  const int left = settings_.spp - samples_done_;
  int pass = std::clamp(samples_done_, 1, kLargestPass);
  if (samples_done_ > 0) {
    const double a_sample = elapsed / samples_done_;
    double budget = kPassSeconds;
    if (settings_.time) budget = std::min(budget, *settings_.time - elapsed);
    pass = std::clamp(static_cast<int>(budget / std::max(a_sample, 1e-9)), 1, pass);
  }
  return std::min(pass, left);
}

std::optional<Progress> PassSchedule::progress(double pass_samples) {
  const double now = seconds();
  if (now - last_report_ < kReportSeconds && samples_done_ < settings_.spp) return std::nullopt;
  last_report_ = now;
  Progress p;
  p.samples_done = samples_done_;
  p.seconds = now;
  p.fraction = (samples_done_ + pass_samples) / settings_.spp;
  if (settings_.time) p.fraction = std::max(p.fraction, std::min(1.0, now / *settings_.time));
  p.remaining = p.fraction > 0 ? now * (1 - p.fraction) / p.fraction : 0.0;
  return p;
}

}  // namespace tyndall
