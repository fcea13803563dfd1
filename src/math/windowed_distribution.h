/// A piecewise constant density over the unit square that can be restricted to any rectangle of it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tyndall/math.h"

namespace tyndall {

/// A rectangle in the unit square; empty where a side is not positive.
struct Window {
  double x0, y0, x1, y1;

  bool contains(double x, double y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
  double area() const { return std::max(x1 - x0, 0.0) * std::max(y1 - y0, 0.0); }
};

/// Density on [0, 1]^2 that is constant in each of width * height equal cells, given row by row. Weights that are negative or
/// not finite count as 0. The integral over a window is read from a summed-area table [Crow 1984], as in portal-masked
/// environment map sampling [Bitterli et al. 2015]. Where a window holds nothing, as far as the table's digits tell, the
/// density is uniform in it.
class WindowedDistribution {
 public:
  struct Sample {
    double x, y;
    double pdf;  ///< 1/area
  };

  WindowedDistribution() = default;
  WindowedDistribution(int width, int height, std::span<const float> weights);

  std::optional<Sample> sample(const Window& window, Vec2 u) const;  ///< nothing in an empty window
  double pdf(const Window& window, double x, double y) const;        ///< 1/area; 0 outside of the window
  double total() const { return width_ > 0 ? sums_.back() : 0; }     ///< sum of the weights
  std::size_t memory_bytes() const { return weights_.capacity() * sizeof(float) + sums_.capacity() * sizeof(double); }

 private:
  std::size_t cell(double x, int n) const;
  double sum(std::size_t x, std::size_t y) const { return sums_[y * (static_cast<std::size_t>(width_) + 1) + x]; }
  double column_sum(std::size_t x, double y) const;  ///< of weights left of cell x and below y, which is in cells
  double sum_left(double x, double y0, double y1) const;
  bool holds_something(double mass) const { return mass > 1e-10 * total(); }

  int width_ = 0, height_ = 0;
  std::vector<float> weights_;
  std::vector<double> sums_;  ///< of all cells before a corner in x and y, (width + 1) * (height + 1)
};

}  // namespace tyndall
