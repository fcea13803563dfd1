#include "math/windowed_distribution.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// The cell in [first, last] in which `mass_before` (of cells, increasing) passes `mass`.
template <typename MassBefore>
std::size_t cell_of_mass(std::size_t first, std::size_t last, double mass, const MassBefore& mass_before) {
  while (first < last) {
    const std::size_t middle = first + (last - first + 1) / 2;
    if (mass_before(middle) <= mass) {
      first = middle;
    } else {
      last = middle - 1;
    }
  }
  return first;
}

}  // namespace

WindowedDistribution::WindowedDistribution(int width, int height, std::span<const float> weights)
    : width_(width), height_(height), weights_(weights.begin(), weights.end()) {
  for (float& w : weights_)
    if (!(w > 0 && std::isfinite(w))) w = 0;
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  sums_.assign((columns + 1) * (rows + 1), 0.0);
  for (std::size_t y = 0; y < rows; ++y) {
    double row = 0;
    for (std::size_t x = 0; x < columns; ++x) {
      row += weights_[y * columns + x];
      sums_[(y + 1) * (columns + 1) + x + 1] = sum(x + 1, y) + row;
    }
  }
}

std::size_t WindowedDistribution::cell(double x, int n) const {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(x * n), 0, n - 1));
}

double WindowedDistribution::column_sum(std::size_t x, double y) const {
  const auto below = static_cast<std::size_t>(std::clamp(y, 0.0, static_cast<double>(height_ - 1)));
  const double t = y - static_cast<double>(below);
  return sum(x, below) + t * (sum(x, below + 1) - sum(x, below));
}

/// Of weights left of x and between y0 and y1, all three in cells.
double WindowedDistribution::sum_left(double x, double y0, double y1) const {
  const auto left = static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(width_ - 1)));
  const double t = x - static_cast<double>(left);
  const double before = column_sum(left, y1) - column_sum(left, y0);
  return before + t * (column_sum(left + 1, y1) - column_sum(left + 1, y0) - before);
}

/// The column by its marginal, then the row within that column; both by inversion, piecewise linear.
std::optional<WindowedDistribution::Sample> WindowedDistribution::sample(const Window& w, Vec2 u) const {
  if (!(w.area() > 0)) return std::nullopt;
  const auto between = [](double a, double b, double t) { return std::clamp(a + (b - a) * t, a, b); };
  const double x0 = w.x0 * width_, x1 = w.x1 * width_, y0 = w.y0 * height_, y1 = w.y1 * height_;
  const double left = sum_left(x0, y0, y1), mass = sum_left(x1, y0, y1) - left;
  Sample s{between(w.x0, w.x1, u.x), between(w.y0, w.y1, u.y), 0};
  if (holds_something(mass)) {
    const double wanted = left + u.x * mass;
    const auto before = [&](std::size_t x) { return column_sum(x, y1) - column_sum(x, y0); };
    const std::size_t column = cell_of_mass(cell(w.x0, width_), cell(w.x1, width_), wanted, before);
    const double own = before(column + 1) - before(column);
    s.x = std::clamp((static_cast<double>(column) + (own > 0 ? (wanted - before(column)) / own : 0.5)) / width_, w.x0, w.x1);

    const auto below = [&](double y) { return column_sum(column + 1, y) - column_sum(column, y); };
    const double low = below(y0), target = low + u.y * (below(y1) - low);
    const std::size_t row = cell_of_mass(cell(w.y0, height_), cell(w.y1, height_), target,
                                         [&](std::size_t y) { return below(static_cast<double>(y)); });
    const double floor = below(static_cast<double>(row)), step = below(static_cast<double>(row + 1)) - floor;
    s.y = std::clamp((static_cast<double>(row) + (step > 0 ? (target - floor) / step : 0.5)) / height_, w.y0, w.y1);
  }
  s.pdf = pdf(w, s.x, s.y);
  return s;
}

double WindowedDistribution::pdf(const Window& w, double x, double y) const {
  if (!(w.area() > 0) || !w.contains(x, y)) return 0;
  const double y0 = w.y0 * height_, y1 = w.y1 * height_;
  const double mass = sum_left(w.x1 * width_, y0, y1) - sum_left(w.x0 * width_, y0, y1);
  if (!holds_something(mass)) return 1 / w.area();
  const double weight = weights_[cell(y, height_) * static_cast<std::size_t>(width_) + cell(x, width_)];
  return weight * width_ * height_ / mass;
}

}  // namespace tyndall
