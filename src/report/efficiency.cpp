#include "report/efficiency.h"

#include <cmath>

#include "report/statistics.h"

namespace tyndall {
namespace {

Estimate estimate_of(std::span<const double> values) {
  Moments moments;
  for (const double v : values) moments.add(v);
  return moments.estimate();
}

}  // namespace

double student_t_95(double dof) {
  double low = 0, high = 1e4;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_two_sided(middle, dof) > 0.05 ? low : high) = middle;
  }
  return high;
}

std::optional<ConfidenceInterval> mean_interval(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  const Estimate e = estimate_of(values);
  const double reach = student_t_95(e.dof) * e.standard_error();
  return ConfidenceInterval{e.mean, e.mean - reach, e.mean + reach};
}

std::optional<double> log_slope(std::span<const ErrorPoint> points) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const ErrorPoint& p : points) {
    if (!(p.x > 0) || !(p.y > 0)) continue;
    const double x = std::log(p.x), y = std::log(p.y);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread = n * sxx - sx * sx;
  if (n < 3 || !(spread > 0)) return std::nullopt;
  return (n * sxy - sx * sy) / spread;
}

std::optional<ConfidenceInterval> relative_efficiency(std::span<const double> base, std::span<const double> other) {
  if (base.size() < 2 || base.size() != other.size()) return std::nullopt;
  const double a = estimate_of(base).mean, b = estimate_of(other).mean;
  if (!(a > 0) || !(b > 0)) return std::nullopt;
  Moments differences;
  for (std::size_t i = 0; i < base.size(); ++i) differences.add(base[i] / a - other[i] / b);
  const Estimate e = differences.estimate();
  const double ratio = std::log(a / b), reach = student_t_95(e.dof) * e.standard_error();
  return ConfidenceInterval{std::exp(ratio), std::exp(ratio - reach), std::exp(ratio + reach)};
}

}  // namespace tyndall
