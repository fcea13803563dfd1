#include "report/uniformity.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

double smirnov_tail(std::size_t n, double d) {
  if (n == 0 || d <= 0) return 1;
  if (d >= 1) return 0;
  const auto count = static_cast<double>(n);
  // Far more terms than digits: the asymptotic form, with its first correction [Smirnov 1944].
  if (n > 10'000) return std::exp(-std::pow(6 * count * d + 1, 2) / (18 * count));
  // d sum_j C(n, j) (1 - d - j/n)^(n - j) (d + j/n)^(j - 1), j = 0 .. n (1 - d)
  double sum = 0;
  for (std::size_t j = 0; j <= n; ++j) {
    const double k = static_cast<double>(j), left = 1 - d - k / count;
    if (left <= 0) break;
    const double choose = std::lgamma(count + 1) - std::lgamma(k + 1) - std::lgamma(count - k + 1);
    sum += std::exp(choose + (count - k) * std::log(left) + (k - 1) * std::log(d + k / count));
  }
  return std::min(1.0, d * sum);
}

double excess_of_small(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  double excess = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    excess = std::max(excess, static_cast<double>(i + 1) / count - values[i]);
  }
  return excess;
}

}  // namespace tyndall
