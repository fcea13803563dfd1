#include "report/statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace tyndall;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Equal to `digits` significant decimal digits.
bool same(double a, double b, int digits = 12) { return std::abs(a - b) <= std::pow(10.0, -digits) * std::abs(b); }

}  // namespace

TEST_CASE("the incomplete beta function against closed forms") {
  for (const double x : {1e-9, 0.01, 0.3, 0.5, 0.77, 0.999}) {
    CAPTURE(x);
    CHECK(same(incomplete_beta(1, 1, x), x));
    CHECK(same(incomplete_beta(3, 1, x), x * x * x));
    CHECK(same(incomplete_beta(1, 4, x), -std::expm1(4 * std::log1p(-x))));
    CHECK(same(incomplete_beta(0.5, 0.5, x), 2 / std::acos(-1.0) * std::asin(std::sqrt(x)), 11));
    CHECK(same(incomplete_beta(2, 3, x), x * x * (6 + x * (-8 + 3 * x)), 11));
    CHECK(same(incomplete_beta(200, 0.5, x) + incomplete_beta(0.5, 200, 1 - x), 1, 11));
  }
  CHECK(incomplete_beta(2, 3, 0) == 0);
  CHECK(incomplete_beta(2, 3, 1) == 1);
}

TEST_CASE("Student's t against closed forms and a printed table") {
  for (const double t : {0.0, 0.1, 1.0, 2.5, 9.0, 1e3}) {
    CAPTURE(t);
    CHECK(same(student_t_two_sided(t, 1), t == 0 ? 1 : 2 / std::acos(-1.0) * std::atan(1 / t), 11));
    CHECK(same(1 - 0.5 * student_t_two_sided(t, 2), 0.5 + t / (2 * std::sqrt(2 + t * t)), 11));
    CHECK(student_t_two_sided(-t, 7) == student_t_two_sided(t, 7));
    CHECK(same(student_t_two_sided(t, 1e9) + 1, std::erfc(t / std::sqrt(2.0)) + 1));
  }
  CHECK(same(student_t_two_sided(2.228138851964939, 10), 0.05, 7));
  CHECK(same(student_t_two_sided(1.972395135, 192), 0.05, 4));
  // Far out the tail keeps its digits: t = 1e3, 2 degrees of freedom: 1 - t / sqrt(2 + t^2).
  CHECK(same(student_t_two_sided(1e3, 2), -std::expm1(-0.5 * std::log1p(2e-6)), 9));
  CHECK(student_t_two_sided(kInfinite, 5) == 0);
  CHECK(student_t_two_sided(3, 0) == 1);
}

TEST_CASE("Sidak's level gives the family level back") {
  CHECK(sidak(0.05, 1) == doctest::Approx(0.05));
  for (const double tests : {2.0, 100.0, 5292.0}) {
    CHECK(same(-std::expm1(tests * std::log1p(-sidak(1e-3, tests))), 1e-3, 9));
  }
}

TEST_CASE("binomial tails: by hand, and the sum of all terms") {
  CHECK(binomial_tail(10, 0.3, 0) == 1);
  CHECK(binomial_tail(10, 0.3, 11) == 0);
  CHECK(same(binomial_tail(10, 0.3, 10), std::pow(0.3, 10)));
  CHECK(same(binomial_tail(3, 0.5, 2), 0.5));
  CHECK(same(binomial_tail(1000, 1e-3, 1), 1 - std::pow(0.999, 1000)));
  double sum = 0;
  for (int k = 7; k <= 40; ++k)
    sum += std::exp(std::lgamma(41) - std::lgamma(k + 1) - std::lgamma(41 - k) + k * std::log(0.1) + (40 - k) * std::log(0.9));
  CHECK(same(binomial_tail(40, 0.1, 7), sum, 11));
}

TEST_CASE("moments and averages") {
  Moments m;
  CHECK(std::isinf(m.estimate().variance));
  for (const double v : {1.0, 2.0, 3.0, 6.0}) m.add(v);
  CHECK(m.estimate().mean == doctest::Approx(3));
  CHECK(m.estimate().variance == doctest::Approx(14.0 / 3 / 4));
  CHECK(m.estimate().dof == 3);

  const Estimate one = average({{2, 0.5, 7}});
  CHECK(one.mean == 2);
  CHECK(one.variance == 0.5);
  CHECK(one.dof == doctest::Approx(7));
  const Estimate exact = average({{2, 0, 3}, {4, 0, 3}});
  CHECK(exact.mean == 3);
  CHECK(exact.variance == 0);
}

TEST_CASE("degrees of freedom of a block: its pixels' add up where they are alike, and one loud pixel counts alone") {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::vector<Estimate> alike, loud;
  for (int i = 0; i < 4096; ++i) {
    Moments m;
    for (int n = 0; n < 4; ++n) m.add(normal(engine));
    alike.push_back(m.estimate());
    loud.push_back({0, i == 17 ? 1e6 : 1.0, 3});
  }
  CHECK(average(alike).dof == doctest::Approx(3 * 4096).epsilon(0.05));
  CHECK(average(loud).dof == doctest::Approx(3).epsilon(0.05));
}

TEST_CASE("Welch's test: a worked example and the cases without noise") {
  // 4 values of variance 1 against 9 of variance 6: t, and nu by Welch's formula, by hand.
  const WelchResult r = welch_test({10, 0.25, 3}, {8, 6.0 / 9, 8});
  const double v = 0.25 + 6.0 / 9;
  CHECK(r.t == doctest::Approx(2 / std::sqrt(v)));
  CHECK(r.dof == doctest::Approx(v * v / (0.0625 / 3 + 36.0 / 81 / 8)));
  CHECK(r.p == doctest::Approx(student_t_two_sided(r.t, r.dof)));
  CHECK(welch_test({1, 0, 3}, {1, 0, 3}).p == 1);
  CHECK(welch_test({1, 0, 3}, {1.5, 0, 3}).p == 0);
  CHECK(welch_test({1, kInfinite, 0}, {1.5, 1, 3}).p == 1);
}

TEST_CASE("p values of equal means are uniform, of unequal ones are not") {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  const auto statistic = [&](double bias) {
    constexpr int kTests = 20'000, kBins = 20;
    std::vector<int> histogram(kBins);
    for (int i = 0; i < kTests; ++i) {
      Moments a, b;
      for (int n = 0; n < 12; ++n) a.add(1 + bias + normal(engine));
      for (int n = 0; n < 30; ++n) b.add(1 + 3 * normal(engine));
      const double p = welch_test(a.estimate(), b.estimate()).p;
      ++histogram[std::min(int(p * kBins), kBins - 1)];
    }
    double chi2 = 0;
    for (const int n : histogram) chi2 += (n - kTests / kBins) * (n - kTests / kBins) / double(kTests / kBins);
    return chi2;
  };
  CHECK(statistic(0) < 50);  // 19 degrees of freedom: p = 1.3e-4 at 50
  CHECK(statistic(0.2) > 100);
}
