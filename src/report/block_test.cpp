#include "report/block_test.h"

#include <algorithm>
#include <cmath>

#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Floats are rounded, and not at random: two noiseless pictures may differ by this much relative to their values.
constexpr double kRounding = 1e-5;

Estimate with_rounding(Estimate e) {
  const double error = kRounding * e.mean;
  e.variance += error * error;
  return e;
}

}  // namespace

std::vector<BlockDifference> block_test(const MeanImage& a, const MeanImage& b) {
  if (a.width != b.width || a.height != b.height) {
    throw Error(Failure::usage, "images of different sizes cannot be tested; render them at one resolution");
  }
  std::vector<BlockDifference> differences;
  for (int channel = 0; channel < 3; ++channel) {
    for (int y = 0; y < a.height; ++y) {
      for (int x = 0; x < a.width; ++x) {
        const Estimate in_a = with_rounding(a.at(x, y, channel)), in_b = with_rounding(b.at(x, y, channel));
        differences.push_back({x, y, channel, welch_test(in_a, in_b)});
      }
    }
  }
  return differences;
}

const BlockDifference& worst(const std::vector<BlockDifference>& differences) {
  return *std::min_element(differences.begin(), differences.end(), [](const auto& a, const auto& b) {
    // By p; far out, where p underflows to 0, by t. A value that is no number is worse than any.
    if (std::isnan(a.welch.p) || std::isnan(b.welch.p)) return std::isnan(a.welch.p) && !std::isnan(b.welch.p);
    if (a.welch.p != b.welch.p) return a.welch.p < b.welch.p;
    return std::abs(a.welch.t) > std::abs(b.welch.t);
  });
}

std::size_t count_below(const std::vector<BlockDifference>& differences, double level) {
  return static_cast<std::size_t>(std::count_if(differences.begin(), differences.end(), [&](const auto& d) {
    return !(d.welch.p >= level);  // a NaN counts
  }));
}

WelchResult mean_test(const MeanImage& a, const MeanImage& b, int channel) {
  return welch_test(with_rounding(image_mean(a, channel)), with_rounding(image_mean(b, channel)));
}

}  // namespace tyndall
