#include "cli/progress_display.h"

#include "cli/duration.h"
#include "cli/log.h"

#include <fmt/core.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall::cli {
namespace {

constexpr double kLineSeconds = 5;
constexpr int kBarWidth = 40;

std::string left_of(const Progress& p) { return p.remaining > 0 || p.fraction >= 1 ? duration(p.remaining) : "?"; }

}  // namespace

ProgressDisplay::ProgressDisplay(const std::string& kind, const std::string& next)
    : kind_(kind), next_(next.empty() ? "" : ", then " + next) {
  if (kind_ == "auto") kind_ = isatty(STDERR_FILENO) ? "bar" : "line";
}

void ProgressDisplay::begin(const std::string& activity) {
  finish();
  activity_ = activity.empty() ? "" : activity + ": ";
  last_line_ = 0;
}

void ProgressDisplay::show(const Progress& p) {
  if (kind_ == "json") {
    const std::string activity = nlohmann::json(activity_.substr(0, activity_.find(':'))).dump();
    log("{{{}{}\"samples\":{},\"fraction\":{:.4f},\"seconds\":{:.2f},\"remaining\":{:.2f}}}\n",
        activity_.empty() ? "" : "\"activity\":" + activity + ",", p.preparing ? "\"preparing\":true," : "", p.samples_done,
        p.fraction, p.seconds, p.remaining);
  } else if (kind_ == "bar") {
    const int full = static_cast<int>(std::lround(p.fraction * kBarWidth));
    const std::string samples = p.preparing          ? "  looking at the film"
                                : p.samples_done > 0 ? fmt::format("  {} spp", p.samples_done)
                                                     : "";
    log("\r{}[{:=<{}}{: <{}}] {:3.0f}%{}  {} left{}   ", activity_, "", full, "", kBarWidth - full, 100 * p.fraction, samples,
        left_of(p), next_);
    drawn_ = true;
  } else if (kind_ == "line" && p.seconds - last_line_ >= kLineSeconds) {
    last_line_ = p.seconds;
    const std::string samples = p.preparing          ? "looking at the film, "
                                : p.samples_done > 0 ? fmt::format("{} spp, ", p.samples_done)
                                                     : "";
    log("{}{:.0f}%, {}{} done, {} left{}\n", activity_, 100 * p.fraction, samples, duration(p.seconds), left_of(p), next_);
  }
}

void ProgressDisplay::finish() {
  if (drawn_) log("\r{: <{}}\r", "", kBarWidth + 40 + static_cast<int>(activity_.size() + next_.size()));
  drawn_ = false;
}

}  // namespace tyndall::cli
