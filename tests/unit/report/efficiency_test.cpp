#include "report/efficiency.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace tyndall {
namespace {

TEST_CASE("Student's t at 95 %: values from the tables") {
  CHECK(student_t_95(1) == doctest::Approx(12.706).epsilon(1e-4));
  CHECK(student_t_95(4) == doctest::Approx(2.776).epsilon(1e-3));
  CHECK(student_t_95(30) == doctest::Approx(2.042).epsilon(1e-3));
}

TEST_CASE("a mean needs two values for its interval") {
  CHECK(!mean_interval(std::vector<double>{1}));
  const auto i = mean_interval(std::vector<double>{1, 2, 3, 4, 5});
  REQUIRE(i);
  CHECK(i->value == doctest::Approx(3));
  CHECK(i->high - i->value == doctest::Approx(2.776 * std::sqrt(2.5 / 5)).epsilon(1e-3));
}

TEST_CASE("slopes of power laws, whatever the scale; points of no error are left out") {
  for (const double slope : {-1.0, -0.5, -1.5}) {
    std::vector<ErrorPoint> points;
    for (double x = 0.01; x < 100; x *= 2) points.push_back({x, 7e-5 * std::pow(x, slope)});
    points.push_back({200, -1e-9});
    CHECK(*log_slope(points) == doctest::Approx(slope));
  }
  CHECK(!log_slope(std::vector<ErrorPoint>{{1, 1}, {2, 0.5}, {4, 0}}));
  CHECK(!log_slope(std::vector<ErrorPoint>{{1, 1}, {1, 2}, {1, 3}}));
}

TEST_CASE("relative efficiency: the interval holds the truth 95 times in 100") {
  std::mt19937 random(7);
  std::lognormal_distribution<double> base(0, 0.1), other(std::log(0.25), 0.3);
  const double truth = std::exp(0.005) / (0.25 * std::exp(0.045));
  int inside = 0;
  constexpr int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) {
    std::vector<double> a, b;
    for (int k = 0; k < 5; ++k) a.push_back(base(random)), b.push_back(other(random));
    const auto e = relative_efficiency(a, b);
    REQUIRE(e);
    inside += e->low <= truth && truth <= e->high;
  }
  // Standard error of the rate 0.35 %; five values from a skew distribution cost about 1 %.
  CHECK(inside > 0.925 * kTrials);
  CHECK(inside < 0.975 * kTrials);
}

TEST_CASE("what both runs of a seed share makes the interval no wider") {
  const std::vector<double> a{1, 2, 0.5, 1.5, 3}, b{2, 4, 1, 3, 6.01};
  const auto e = relative_efficiency(a, b);
  REQUIRE(e);
  CHECK(e->value == doctest::Approx(0.5).epsilon(1e-2));
  CHECK(e->high / e->low < 1.01);
}

TEST_CASE("no efficiency without an error to divide by") {
  CHECK(!relative_efficiency(std::vector<double>{1, 1.1}, std::vector<double>{1e-9, -2e-9}));
  CHECK(!relative_efficiency(std::vector<double>{1}, std::vector<double>{1, 1}));
}

}  // namespace
}  // namespace tyndall
