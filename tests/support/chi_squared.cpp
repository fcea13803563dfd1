#include "support/chi_squared.h"

#include <array>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

namespace tyndall::test {

namespace {

constexpr double kTau = 6.28318530717958647692;

/// Directions in polar coordinates around the axis.
class PolarFrame {
 public:
  explicit PolarFrame(Vec3 axis) : z_(normalize(axis)) {
    x_ = normalize(std::abs(z_.x) < 0.5f ? cross(z_, {1, 0, 0}) : cross(z_, {0, 1, 0}));
    y_ = cross(z_, x_);
  }
  Vec3 direction(double theta, double phi) const {
    const double s = std::sin(theta);
    return normalize(x_ * float(s * std::cos(phi)) + y_ * float(s * std::sin(phi)) + z_ * float(std::cos(theta)));
  }
  /// By the arc tangent of both components: the arc cosine would blur angles below 1e-3.
  double theta(Vec3 w) const { return std::atan2(std::hypot(double(dot(w, x_)), dot(w, y_)), dot(w, z_)); }
  double phi(Vec3 w) const {
    const double phi = std::atan2(dot(w, y_), dot(w, x_));
    return phi < 0 ? phi + kTau : phi;
  }

 private:
  Vec3 x_, y_, z_;
};

/// theta0, theta1, phi0, phi1
struct Cell {
  double t0, t1, p0, p1;
};

// Gauss-Lobatto nodes and weights on [-1, 1]: the ends are among them, so that a jump next to an edge is noticed.
constexpr std::array<double, 6> kNodes{
    -1, -0.765055323929464693, -0.285231516480645096, 0.285231516480645096, 0.765055323929464693, 1};
constexpr std::array<double, 6> kWeights{
    1 / 15.0, 0.378474956297846980, 0.554858377035486353, 0.554858377035486353, 0.378474956297846980, 1 / 15.0};

class CellIntegrator {
 public:
  CellIntegrator(const DirectionDensity& pdf, const PolarFrame& frame, double tolerance)
      : pdf_(pdf), frame_(frame), tolerance_(tolerance) {}

  double operator()(const Cell& cell) const { return refine(cell, rule(cell), 0); }

 private:
  static constexpr int kMaxDepth = 9;

  double rule(const Cell& c) const {
    const double ht = (c.t1 - c.t0) / 2, hp = (c.p1 - c.p0) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      const double theta = c.t0 + ht * (1 + kNodes[i]);
      double row = 0;
      for (std::size_t j = 0; j < kNodes.size(); ++j)
        row += kWeights[j] * pdf_(frame_.direction(theta, c.p0 + hp * (1 + kNodes[j])));
      sum += kWeights[i] * std::sin(theta) * row;
    }
    return sum * ht * hp;
  }

  double refine(const Cell& c, double whole, int depth) const {
    const double tm = (c.t0 + c.t1) / 2, pm = (c.p0 + c.p1) / 2;
    const std::array<Cell, 4> parts{{{c.t0, tm, c.p0, pm}, {c.t0, tm, pm, c.p1}, {tm, c.t1, c.p0, pm}, {tm, c.t1, pm, c.p1}}};
    std::array<double, 4> sums;
    for (std::size_t i = 0; i < 4; ++i) sums[i] = rule(parts[i]);
    const double fine = std::accumulate(sums.begin(), sums.end(), 0.0);
    if (std::abs(fine - whole) < tolerance_ || depth == kMaxDepth) return fine;
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += refine(parts[i], sums[i], depth + 1);
    return sum;
  }

  const DirectionDensity& pdf_;
  const PolarFrame& frame_;
  double tolerance_;
};

double theta_edge(const ChiSquaredOptions& o, int i) { return kTau / 2 * std::pow(double(i) / o.theta_bins, o.theta_power); }

std::vector<double> bin_probabilities(const DirectionDensity& pdf, const PolarFrame& frame, const ChiSquaredOptions& o) {
  // A bin may be wrong by a hundredth of a sample: far below the noise of the bins that are kept (>= 5 samples).
  const CellIntegrator integrate(pdf, frame, 0.01 / double(o.samples));
  std::vector<double> p;
  for (int i = 0; i < o.theta_bins; ++i)
    for (int j = 0; j < o.phi_bins; ++j)
      p.push_back(integrate({theta_edge(o, i), theta_edge(o, i + 1), kTau * j / o.phi_bins, kTau * (j + 1) / o.phi_bins}));
  return p;
}

std::size_t bin_of(Vec3 w, const PolarFrame& frame, const ChiSquaredOptions& o) {
  const double t = std::pow(frame.theta(w) / (kTau / 2), 1 / o.theta_power);
  const int i = std::clamp(int(t * o.theta_bins), 0, o.theta_bins - 1);
  const int j = std::clamp(int(frame.phi(w) / kTau * o.phi_bins), 0, o.phi_bins - 1);
  return std::size_t(i) * std::size_t(o.phi_bins) + std::size_t(j);
}

struct Pooled {
  double statistic = 0;
  int bins = 0;
};

/// sum (observed - expected)^2 / expected, neighbouring bins joined until each expects at least 5.
Pooled pooled_statistic(const std::vector<double>& expected, const std::vector<double>& observed) {
  Pooled result;
  double small_expected = 0, small_observed = 0;
  const auto add = [&](double e, double n) {
    result.statistic += (n - e) * (n - e) / e;
    ++result.bins;
  };
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] >= 5) {
      add(expected[i], observed[i]);
      continue;
    }
    small_expected += expected[i];
    small_observed += observed[i];
    if (small_expected >= 5) {
      add(small_expected, small_observed);
      small_expected = small_observed = 0;
    }
  }
  // What is left expects fewer than 5. Counts there are held to the floor of 5, which is only ever lenient.
  if (small_observed > small_expected) add(std::max(small_expected, 5.0), std::max(small_observed, 5.0));
  return result;
}

}  // namespace

ChiSquaredResult chi_squared_test(const DirectionSampler& sample, const DirectionDensity& pdf,
                                  const ChiSquaredOptions& options) {
  const PolarFrame frame(options.axis);
  ChiSquaredResult result{.alpha = options.alpha};

  // What the density promises, the draws without a direction last.
  std::vector<double> expected = bin_probabilities(pdf, frame, options);
  result.density_integral = std::accumulate(expected.begin(), expected.end(), 0.0);
  expected.push_back(std::max(0.0, 1 - result.density_integral));
  for (double& e : expected) e *= double(options.samples);

  // What the sampler does.
  std::vector<double> observed(expected.size(), 0.0);
  std::mt19937_64 engine(options.seed);
  const Uniform uniform = [&] { return float(engine() >> 40) * 0x1p-24f; };
  for (std::size_t n = 0; n < options.samples; ++n) {
    const std::optional<Vec3> w = sample(uniform);
    observed[w ? bin_of(*w, frame, options) : expected.size() - 1] += 1;
    if (w && !(pdf(*w) > 0)) ++result.impossible;
  }
  result.sampled_fraction = 1 - observed.back() / double(options.samples);

  // Are they the same?
  const Pooled pooled = pooled_statistic(expected, observed);
  result.statistic = pooled.statistic;
  result.degrees_of_freedom = pooled.bins - 1;
  if (result.degrees_of_freedom < 1) return result;  // one bin proves nothing: failed, with 0 degrees of freedom
  result.p_value = chi_squared_tail(result.statistic, result.degrees_of_freedom);
  result.detectable_deviation =
      std::sqrt(detectable_noncentrality(result.degrees_of_freedom, options.alpha, 0.99) / double(options.samples));
  result.passed = result.p_value >= options.alpha && result.impossible == 0 && result.density_integral < 1 + 1e-3;
  return result;
}

double integrate_over_sphere(const DirectionDensity& pdf, const ChiSquaredOptions& options) {
  const std::vector<double> p = bin_probabilities(pdf, PolarFrame(options.axis), options);
  return std::accumulate(p.begin(), p.end(), 0.0);
}

std::string ChiSquaredResult::summary() const {
  std::array<char, 320> text;
  std::snprintf(text.data(), text.size(),
                "chi2 = %.1f with %d degrees of freedom, p = %.3g (alpha %.3g); density integrates to %.6f, "
                "sampled fraction %.6f, %zu samples of density 0; finds an rms deviation of %.3g with power 0.99",
                statistic, degrees_of_freedom, p_value, alpha, density_integral, sampled_fraction, impossible,
                detectable_deviation);
  return text.data();
}

double sidak(double family_alpha, int tests) { return -std::expm1(std::log1p(-family_alpha) / tests); }

double count_p_value(const std::vector<double>& counts, const std::vector<double>& pmf, int draws) {
  double statistic = 0, rest = 0, rest_expected = 0;
  int bins = 0;
  const auto add = [&](double count, double expected) {
    statistic += (count - expected) * (count - expected) / expected;
    ++bins;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = pmf[i] * draws;
    if (expected >= 5) {
      add(counts[i], expected);
    } else {
      rest += counts[i];
      rest_expected += expected;
    }
  }
  if (rest_expected >= 5) add(rest, rest_expected);
  return bins > 1 ? chi_squared_tail(statistic, bins - 1) : 1;
}

double chi_squared_tail(double x, double degrees_of_freedom) { return x <= 0 ? 1 : upper_gamma(degrees_of_freedom / 2, x / 2); }

namespace {

/// P(X > x), X noncentral chi-squared: a Poisson mixture of central ones, summed outwards from the mode.
double noncentral_tail(double x, double degrees_of_freedom, double noncentrality) {
  const double half = noncentrality / 2;
  const auto term = [&](int j) {
    const double weight = std::exp(-half + j * std::log(half) - std::lgamma(j + 1.0));
    return weight * chi_squared_tail(x, degrees_of_freedom + 2 * j);
  };
  const int mode = int(half), reach = int(10 * std::sqrt(half + 1)) + 10;
  double sum = 0;
  for (int j = std::max(0, mode - reach); j <= mode + reach; ++j) sum += term(j);
  return sum;
}

/// The x where a decreasing function falls to `target`.
template <typename Function>
double solve_decreasing(const Function& f, double target, double high) {
  double low = 0;
  while (f(high) > target) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) > target ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

double detectable_noncentrality(double degrees_of_freedom, double alpha, double power) {
  const double critical =
      solve_decreasing([&](double x) { return chi_squared_tail(x, degrees_of_freedom); }, alpha, degrees_of_freedom);
  return solve_decreasing([&](double l) { return 1 - noncentral_tail(critical, degrees_of_freedom, std::max(l, 1e-9)); },
                          1 - power, 1.0);
}

double upper_gamma(double a, double x) {
  if (x <= 0) return 1;
  const double scale = std::exp(-x + a * std::log(x) - std::lgamma(a));

  // P(a, x) by its power series where that converges fast.
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; std::abs(term) > 1e-16 * sum; ++n) sum += term *= x / n;
    return 1 - scale * sum;
  }

  // Q(a, x) by its continued fraction, evaluated from the front [Lentz 1976].
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int i = 1; i < 10'000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return scale * h;
}

}  // namespace tyndall::test
