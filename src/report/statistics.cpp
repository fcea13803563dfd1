#include "report/statistics.h"

#include <cmath>
#include <limits>

namespace tyndall {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The continued fraction of I_x(a, b), evaluated from the front [Lentz 1976]; fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1, d = 1 / away_from_zero(1 - (a + b) * x / (a + 1)), h = d;
  for (int m = 1; m < 100'000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / away_from_zero(1 + even * d);
    c = away_from_zero(1 + even / c);
    h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / away_from_zero(1 + odd * d);
    c = away_from_zero(1 + odd / c);
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return h;
}

/// I_x(a, b) given 1 - x as well, which the caller may know without cancellation.
double incomplete_beta(double a, double b, double x, double one_minus_x) {
  if (x <= 0) return 0;
  if (one_minus_x <= 0) return 1;
  const double log_front = std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log(one_minus_x);
  const double front = std::exp(log_front);
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(a, b, x) / a;
  return 1 - front * beta_fraction(b, a, one_minus_x) / b;
}

}  // namespace

double incomplete_beta(double a, double b, double x) { return incomplete_beta(a, b, x, 1 - x); }

double student_t_two_sided(double t, double dof) {
  if (std::isinf(dof) || dof > 1e8) return std::erfc(std::abs(t) / std::sqrt(2.0));
  if (!(dof > 0)) return 1;
  // P(|T| >= |t|) = I_x(dof/2, 1/2) with x = dof / (dof + t^2).
  const double t2 = t * t;
  if (std::isinf(t2)) return 0;
  return incomplete_beta(dof / 2, 0.5, dof / (dof + t2), t2 / (dof + t2));
}

double binomial_tail(std::size_t trials, double p, std::size_t count) {
  if (count == 0) return 1;
  if (count > trials) return 0;
  return incomplete_beta(static_cast<double>(count), static_cast<double>(trials - count + 1), p);
}

double sidak(double family_alpha, double tests) { return -std::expm1(std::log1p(-family_alpha) / tests); }

double Estimate::standard_error() const { return std::sqrt(variance); }

void Moments::add(double value) {
  ++count_;
  const double before = value - mean_;
  mean_ += before / static_cast<double>(count_);
  squares_ += before * (value - mean_);
}

Estimate Moments::estimate() const {
  if (count_ < 2) return {mean_, kInfinite, 0};
  const auto n = static_cast<double>(count_);
  return {mean_, squares_ / ((n - 1) * n), n - 1};
}

Estimate average(const std::vector<Estimate>& parts) {
  double mean = 0, variance = 0, spread = 0;
  for (const Estimate& e : parts) {
    mean += e.mean;
    variance += e.variance;
    // E[v^2] = (1 + 2/dof) V^2 for an estimated variance v of V, so v^2 / (dof + 2) stands for V^2 / dof.
    spread += e.variance * e.variance / (e.dof + 2);
  }
  const auto n = static_cast<double>(parts.size());
  const double dof = variance > 0 ? (spread > 0 ? variance * variance / spread - 2 : kInfinite) : kInfinite;
  return {mean / n, variance / (n * n), dof};
}

WelchResult welch_test(const Estimate& a, const Estimate& b) {
  WelchResult result{.difference = a.mean - b.mean, .dof = kInfinite};
  const double variance = a.variance + b.variance;
  result.standard_error = std::sqrt(variance);
  if (variance == 0) {  // two exact values
    result.t = result.difference == 0 ? 0 : std::copysign(kInfinite, result.difference);
    result.p = result.difference == 0 ? 1 : 0;
    return result;
  }
  if (std::isinf(variance)) return {result.difference, kInfinite, 0, 0, 1};
  result.t = result.difference / result.standard_error;
  const double spread = a.variance * a.variance / a.dof + b.variance * b.variance / b.dof;
  if (spread > 0) result.dof = variance * variance / spread;
  result.p = student_t_two_sided(result.t, result.dof);
  return result;
}

}  // namespace tyndall
