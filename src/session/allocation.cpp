#include "session/allocation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tyndall {
namespace {

constexpr double kLeastShare = 0.25;  ///< of the mean
constexpr double kMostGrowth = 4;
/// Of the largest error: what has shown no noise is not known to have none.
constexpr double kLeastError = 1e-6;
constexpr int kSteps = 100;  ///< halvings of an interval of numbers up to 2^kRange times apart
constexpr double kRange = 80;

struct Wish {
  double amount;       ///< in proportion
  double least, most;  ///< samples
  double pixels;

  double at(double scale) const { return std::clamp(scale * amount, least, most); }
};

/// Of samples over all pixels.
double total(const std::vector<Wish>& wishes, double scale) {
  double sum = 0;
  for (const Wish& w : wishes) sum += w.pixels * w.at(scale);
  return sum;
}

/// With which the total is `samples`, or as near to it as can be.
double scale_for(const std::vector<Wish>& wishes, double samples) {
  double low = -kRange, high = kRange;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = (low + high) / 2;
    (total(wishes, std::exp2(middle)) < samples ? low : high) = middle;
  }
  return std::exp2(high);
}

/// Where the picture is as good as it shall be in the mean, or cannot have what its worst part takes. `wishes`: with that as
/// the least.
bool worst_comes_first(std::span<const BlockNoise> blocks, const std::vector<Wish>& wishes, const SampleBudget& budget) {
  if (budget.goal.worst == kInfinity) return false;
  double pixels = 0;
  for (const Wish& w : wishes) pixels += w.pixels;
  return mean_error(blocks) < budget.goal.mean || total(wishes, 0) > budget.mean * pixels;
}

std::vector<double> pooled_errors(std::span<const BlockNoise> blocks, int across) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < blocks.size(); ++i) errors.push_back(pooled_error(blocks, across, static_cast<int>(i)));
  return errors;
}

std::vector<Wish> wishes_of(std::span<const BlockNoise> blocks, int across, const SampleBudget& budget) {
  const std::vector<double> error = pooled_errors(blocks, across);
  const double largest = *std::max_element(error.begin(), error.end());
  double work = 0;
  for (const BlockNoise& b : blocks) work = std::max(work, b.work / b.pixels);
  std::vector<Wish> wishes, of_worst;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const BlockNoise& b = blocks[i];
    const double relative_error = largest > 0 ? std::max(error[i] / largest, kLeastError) : 1;
    const double relative_work = work > 0 ? std::max(b.work / b.pixels / work, kLeastError) : 1;
    const double most = std::max<double>(b.samples, std::min<double>(budget.most, kMostGrowth * b.samples));
    const double least = std::clamp(kLeastShare * budget.mean, static_cast<double>(b.samples), most);
    const double needed = std::clamp(error[i] / budget.goal.worst, least, most);
    wishes.push_back({std::sqrt(relative_error / relative_work), needed, most, b.pixels});
    of_worst.push_back({relative_error, least, most, b.pixels});
  }
  return worst_comes_first(blocks, wishes, budget) ? of_worst : wishes;
}

}  // namespace

double mean_error(std::span<const BlockNoise> blocks) {
  double error = 0, pixels = 0;
  for (const BlockNoise& b : blocks) {
    error += b.error / b.samples;
    pixels += b.pixels;
  }
  return error / pixels;
}

std::vector<double> errors_around(std::vector<BlockNoise> blocks, int across) {
  for (BlockNoise& b : blocks) b.error /= b.samples;
  return pooled_errors(blocks, across);
}

double worst_error(std::vector<BlockNoise> blocks, int across) {
  const std::vector<double> errors = errors_around(std::move(blocks), across);
  return *std::max_element(errors.begin(), errors.end());
}

double pooled_error(std::span<const BlockNoise> blocks, int across, int at) {
  const int down = static_cast<int>(blocks.size()) / across, x = at % across, y = at / across;
  double error = 0, pixels = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, down - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, across - 1); ++u) {
      const double weight = (u == x ? 2.0 : 1.0) * (v == y ? 2.0 : 1.0);
      const BlockNoise& b = blocks[static_cast<std::size_t>(v * across + u)];
      error += weight * b.error;
      pixels += weight * b.pixels;
    }
  }
  return error / pixels;
}

std::vector<int> allot(std::span<const BlockNoise> blocks, int across, const SampleBudget& budget) {
  const std::vector<Wish> wishes = wishes_of(blocks, across, budget);
  double pixels = 0;
  for (const Wish& w : wishes) pixels += w.pixels;
  const double scale = scale_for(wishes, budget.mean * pixels);
  std::vector<int> samples;
  for (const Wish& w : wishes) {
    const int nearest = static_cast<int>(2 * std::lround(w.at(scale) / 2));
    samples.push_back(nearest <= w.most ? nearest : static_cast<int>(w.most) / 2 * 2);
  }
  return samples;
}

}  // namespace tyndall
