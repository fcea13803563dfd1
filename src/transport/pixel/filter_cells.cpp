#include "transport/pixel/filter_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
/// Pixels. Filters of pbrt's scenes hardly vary over so much (docs/measurements.md).
constexpr double kSide = 0.25;
/// What a cell has at least of the even density: filters with negative lobes pass zero.
constexpr double kLeast = 0.01;
constexpr int kLooks = 8;

}  // namespace

FilterCells::FilterCells(const FilterSampler& filter) : x_(filter, 0), y_(filter, 1) {}

FilterCells::Axis::Axis(const FilterSampler& filter, int axis) : axis_(axis) {
  const double radius = filter.radius(axis);
  const std::size_t count = filter.is_even(axis) ? 1 : static_cast<std::size_t>(std::ceil(2 * radius / kSide));
  for (std::size_t i = 0; i <= count; ++i)
    ends_.push_back(radius * (2 * static_cast<double>(i) / static_cast<double>(count) - 1));
  for (std::size_t i = 0; i < count; ++i) {
    double mean = 0;
    for (int k = 0; k < kLooks; ++k) {
      const double x = ends_[i] + (ends_[i + 1] - ends_[i]) * (k + 0.5) / kLooks;
      mean += static_cast<double>(filter.pdf(axis, static_cast<float>(x))) / kLooks;
    }
    densities_.push_back(std::max(mean, kLeast / (2 * radius)));
  }
}

FilterCells::Axis::Cells FilterCells::Axis::cells_of(const ConvexPolygon& polygon) const {
  const Rectangle box = polygon.bounds();
  const auto cell_of = [&](double x) {
    const double at = (x - begin()) / (end() - begin()) * static_cast<double>(densities_.size());
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(densities_.size() - 1)));
  };
  return {cell_of(box.min[axis_]), cell_of(box.max[axis_])};
}

ConvexPolygon FilterCells::Axis::cut(const ConvexPolygon& polygon, std::size_t cell) const {
  const double from = ends_[cell], to = ends_[cell + 1];
  return axis_ == 0 ? polygon.cut({{from, -kEndless}, {to, kEndless}}) : polygon.cut({{-kEndless, from}, {kEndless, to}});
}

FilterCells::Axis::Masses FilterCells::Axis::masses(const ConvexPolygon& polygon, Cells cells) const {
  Masses masses;
  double before = 0;
  for (std::size_t i = cells.first; i <= cells.last; ++i) {
    const double below = i == cells.last ? polygon.area() : polygon.area_below(axis_, ends_[i + 1]);
    masses.push_back(std::max(below - before, 0.0) * densities_[i]);
    before = below;
  }
  return masses;
}

double FilterCells::Axis::draw(ConvexPolygon& polygon, float& u) const {
  if (polygon.empty()) return 0;
  const Cells cells = cells_of(polygon);
  if (cells.first == cells.last) return 1;
  const Masses weights = masses(polygon, cells);
  double sum = 0;
  for (const double w : weights) sum += w;
  if (!(sum > 0)) return 0;
  double left = u * sum;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    chosen = i;
    if (left < weights[i]) break;
    left -= weights[i];
  }
  u = std::clamp(static_cast<float>(left / weights[chosen]), 0.0f, kOneMinusEpsilon);
  polygon = cut(polygon, cells.first + chosen);
  return weights[chosen] / sum;
}

double FilterCells::mass(const ConvexPolygon& polygon) const {
  const ConvexPolygon held = polygon.cut(support());
  if (held.empty()) return 0;
  const auto columns = x_.cells_of(held);
  double sum = 0;
  for (std::size_t i = columns.first; i <= columns.last; ++i) {
    const ConvexPolygon column = x_.cut(held, i);
    if (column.empty()) continue;
    for (const double mass : y_.masses(column, y_.cells_of(column))) sum += mass * x_.density(i);
  }
  return sum;
}

FilterCells::Place FilterCells::sample(const ConvexPolygon& polygon, Vec2 u) const {
  ConvexPolygon part = polygon.cut(support());
  const double of_column = x_.draw(part, u.x), of_row = of_column > 0 ? y_.draw(part, u.y) : 0;
  const double area = part.area();
  return of_row > 0 && area > 0 ? Place{part.sample(u), of_column * of_row / area} : Place{{0, 0}, 0};
}

}  // namespace tyndall
