/// Distributions and tests that decide whether two noisy measurements agree.
#pragma once

#include <cstddef>
#include <vector>

namespace tyndall {

/// Regularised incomplete beta function I_x(a, b); a, b > 0, x in [0, 1].
double incomplete_beta(double a, double b, double x);

/// P(|T| >= |t|), T Student's t with `dof` degrees of freedom (any real number above 0, infinity: normal); without cancellation
/// for large |t|.
double student_t_two_sided(double t, double dof);

/// P(X >= count), X binomial: `trials` of chance `p` each, in (0, 1).
double binomial_tail(std::size_t trials, double p, std::size_t count);

/// Level of each of `tests` independent tests for a family level `family_alpha` [Sidak 1967].
double sidak(double family_alpha, double tests);

/// A measured mean and how well it is known.
struct Estimate {
  double mean = 0;
  double variance = 0;  ///< of the mean
  double dof = 0;       ///< degrees of freedom that `variance` was estimated with; infinity: exact

  double standard_error() const;
};

/// Running mean and variance of independent, identically distributed values [Welford 1962].
class Moments {
 public:
  void add(double value);
  std::size_t count() const { return count_; }
  /// Of the mean. Below two values the variance is infinite, with no degrees of freedom.
  Estimate estimate() const;

 private:
  std::size_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

/// The mean of independent estimates, equally weighted; its degrees of freedom by Satterthwaite's rule.
Estimate average(const std::vector<Estimate>& parts);

struct WelchResult {
  double difference = 0;      ///< a - b
  double standard_error = 0;  ///< of the difference
  double t = 0;               ///< difference / standard_error; 0 when both are 0
  double dof = 0;
  double p = 1;  ///< two-sided
};

/// Do two means with different variances agree [Welch 1947]?
WelchResult welch_test(const Estimate& a, const Estimate& b);

}  // namespace tyndall
