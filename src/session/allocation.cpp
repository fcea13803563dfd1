#include "session/allocation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tyndall {
namespace {

constexpr int kSteps = 100;  ///< halvings of an interval of numbers up to 2^kRange times apart
constexpr double kRange = 80;

int samples_at(const BlockShare& block, double scale) {
  const double wanted = std::min(std::max(scale * block.amount, double(block.least)), double(block.most));
  return 2 * static_cast<int>(std::lround(wanted / 2));
}

double work_at(std::span<const BlockShare> blocks, double scale) {
  double sum = 0;
  for (const BlockShare& b : blocks) sum += b.work * samples_at(b, scale);
  return sum;
}

}  // namespace

double mean_error(std::span<const BlockNoise> blocks) {
  double error = 0, pixels = 0;
  for (const BlockNoise& b : blocks) {
    error += b.error;
    pixels += b.pixels;
  }
  return error / pixels;
}

std::vector<double> errors_around(std::span<const BlockNoise> blocks, int across) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < blocks.size(); ++i) errors.push_back(pooled_error(blocks, across, static_cast<int>(i)));
  return errors;
}

double worst_error(std::span<const BlockNoise> blocks, int across) {
  const std::vector<double> errors = errors_around(blocks, across);
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

std::vector<int> allot(std::span<const BlockShare> blocks, int everywhere) {
  double budget = 0;
  for (const BlockShare& b : blocks) budget += b.work * everywhere;
  double low = -kRange, high = kRange;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = (low + high) / 2;
    (work_at(blocks, std::exp2(middle)) <= budget ? low : high) = middle;
  }
  std::vector<int> samples;
  for (const BlockShare& b : blocks) samples.push_back(samples_at(b, std::exp2(low)));
  return samples;
}

}  // namespace tyndall
