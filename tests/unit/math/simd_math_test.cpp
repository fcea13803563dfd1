#include "math/simd_math.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// Largest relative error of eight-at-once over `count` places from low to high, in equal ratios.
template <typename Fast, typename Exact>
double worst(Fast fast, Exact exact, double low, double high, int count) {
  double largest = 0;
  for (int i = 0; i <= count; ++i) {
    const auto x = static_cast<float>(low * std::pow(high / low, double(i) / count));
    const Float8 value = fast(Float8(x));
    for (int k = 0; k < 8; ++k) largest = std::max(largest, std::abs(double(value[k]) / exact(double(x)) - 1));
  }
  return largest;
}

TEST_CASE("approximations keep their promise") {
  CHECK(worst(
            fast_rsqrt, [](double x) { return 1 / std::sqrt(x); }, 1.2e-38, 3e38, 200'000) < 5e-6);
  CHECK(worst(
            fast_exp_minus, [](double x) { return std::exp(-x); }, 1e-30, 80, 200'000) < 1e-5);
  CHECK(worst([](Float8 r) { return r * fast_atan_ratio(r * r); }, [](double r) { return std::atan(r); }, 1e-15, 1, 200'000) <
        5e-6);
  CHECK(float(fast_exp_minus(0.0f)[0]) == doctest::Approx(1).epsilon(1e-5));
}

}  // namespace
}  // namespace tyndall
