#include "report/stated_error.h"

#include <algorithm>
#include <array>

#include "report/metrics.h"
#include "tyndall/relative_error.h"

namespace tyndall {
namespace {

constexpr std::array kRgb{"R", "G", "B"};
constexpr double kRounding = 1e-5;  ///< of a value: means of halves are the mean of all up to this

/// Mean over 3x3 pixels, fewer at the edge.
std::vector<double> pooled(const std::vector<float>& values, int width, int height) {
  std::vector<double> means(values.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      int count = 0;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u, ++count)
          sum += values[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
      means[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = sum / count;
    }
  }
  return means;
}

struct Count {
  std::size_t within = 0, all = 0;

  /// Values that are what they are without noise say nothing.
  void add(double squared, double expected, double reference) {
    const double rounding = kRounding * kRounding * reference * reference;
    if (expected == 0 && squared <= rounding) return;
    ++all;
    within += squared <= 4 * expected + rounding;
  }
};

}  // namespace

std::optional<StatedErrors> stated_errors(const Image& image, const Image& reference) {
  if (!image.find("Mse.R") || !image.find("Mse.G") || !image.find("Mse.B")) return std::nullopt;
  std::vector<double> relative(image.data.size());  // of each pixel, mean over channels
  Count count;
  for (const std::string channel : kRgb) {
    const auto &values = required_channel(image, channel).values, &mse = required_channel(image, "Mse." + channel).values;
    const auto& truth = required_channel(reference, channel).values;
    const auto noise = pooled(required_channel(reference, "Variance." + channel).values, image.width(), image.height());
    for (std::size_t i = 0; i < relative.size(); ++i) {
      const double r = truth[i], difference = values[i] - r, stated = mse[i];
      relative[i] += stated / (r * r + kRelativeEpsilon) / 3;
      count.add(difference * difference, stated + noise[i], r);
    }
  }
  StatedErrors result;
  result.relmse = trimmed_mean(relative, 0);
  result.relmse_trimmed = trimmed_mean(relative, kTrimmedFraction);
  result.within_two = count.all > 0 ? static_cast<double>(count.within) / static_cast<double>(count.all) : 1;
  return result;
}

}  // namespace tyndall
