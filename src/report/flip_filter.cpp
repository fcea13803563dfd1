#include "report/flip_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tyndall {
namespace {

int radius_of(const Kernel& kernel) { return static_cast<int>(kernel.size() / 2); }

/// `line` with its ends repeated `radius` times.
void pad(const float* line, int count, int stride, int radius, std::vector<float>& padded) {
  padded.resize(static_cast<std::size_t>(count + 2 * radius));
  for (int i = -radius; i < count + radius; ++i) {
    padded[static_cast<std::size_t>(i + radius)] = line[static_cast<std::ptrdiff_t>(std::clamp(i, 0, count - 1)) * stride];
  }
}

void filter_line(float* line, int count, int stride, const Kernel& kernel, std::vector<float>& padded) {
  pad(line, count, stride, radius_of(kernel), padded);
  for (int i = 0; i < count; ++i) {
    line[static_cast<std::ptrdiff_t>(i) * stride] = std::inner_product(kernel.begin(), kernel.end(), padded.begin() + i, 0.0f);
  }
}

Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const float w : kernel) (w > 0 ? positive : negative) += std::abs(w);
  for (float& w : kernel) w = static_cast<float>(w / (w > 0 ? positive : negative));
  return kernel;
}

}  // namespace

Plane filtered(const Plane& plane, const Kernel& across, const Kernel& down) {
  Plane result = plane;
  std::vector<float> padded;
  for (int y = 0; y < plane.height; ++y) {
    filter_line(result.values.data() + static_cast<std::ptrdiff_t>(y) * plane.width, plane.width, 1, across, padded);
  }
  for (int x = 0; x < plane.width; ++x) filter_line(result.values.data() + x, plane.height, plane.width, down, padded);
  return result;
}

Kernel gaussian(double deviation, int radius) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(static_cast<float>(std::exp(-x * x / (2 * deviation * deviation))));
  return kernel;
}

Kernel normalized(Kernel kernel) {
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (float& w : kernel) w = static_cast<float>(w / sum);
  return kernel;
}

Kernel edge_kernel(double deviation, int radius) {
  Kernel kernel = gaussian(deviation, radius);
  for (int x = -radius; x <= radius; ++x) kernel[static_cast<std::size_t>(x + radius)] *= static_cast<float>(-x);
  return balanced(std::move(kernel));
}

Kernel point_kernel(double deviation, int radius) {
  Kernel kernel = gaussian(deviation, radius);
  for (int x = -radius; x <= radius; ++x) {
    kernel[static_cast<std::size_t>(x + radius)] *= static_cast<float>(x * x / (deviation * deviation) - 1);
  }
  return balanced(std::move(kernel));
}

}  // namespace tyndall
