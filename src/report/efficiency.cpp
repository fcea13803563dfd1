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

std::optional<Interval> mean_interval(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  const Estimate e = estimate_of(values);
  const double reach = student_t_95(e.dof) * e.standard_error();
  return Interval{e.mean, e.mean - reach, e.mean + reach};
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

std::optional<Interval> relative_efficiency(std::span<const double> base, std::span<const double> other) {
  if (base.size() < 2 || other.size() < 2) return std::nullopt;
  const Estimate a = estimate_of(base), b = estimate_of(other);
  if (!(a.mean > 0) || !(b.mean > 0)) return std::nullopt;
  // Var log m = Var m / m^2, and Welch's degrees of freedom for the difference of two such logarithms.
  const Estimate log_a{std::log(a.mean), a.variance / (a.mean * a.mean), a.dof};
  const Estimate log_b{std::log(b.mean), b.variance / (b.mean * b.mean), b.dof};
  const WelchResult w = welch_test(log_a, log_b);
  const double reach = w.standard_error > 0 ? student_t_95(w.dof) * w.standard_error : 0;
  return Interval{std::exp(w.difference), std::exp(w.difference - reach), std::exp(w.difference + reach)};
}

}  // namespace tyndall
