/// A chi-squared test for samplers of directions: do the samples follow the stated density?
///
/// The sphere is cut into bins in polar coordinates around an axis. Each bin's probability is the density integrated
/// over it by adaptive quadrature; its count comes from drawing samples. Draws that give no direction (absorbed, or
/// a specular lobe) form one more bin of probability 1 - integral of the density, so lost mass is tested as well.
///
///     const auto result = chi_squared_test(
///         [&](const Uniform& random) -> std::optional<Vec3> {
///           const Vec2 u{random(), random()};   // in two statements where the order matters
///           return square_to_cosine_hemisphere(u);
///         },
///         [](Vec3 w) { return cosine_hemisphere_pdf(w); }, {.alpha = sidak(1e-3, number_of_tests)});
///     CHECK_MESSAGE(result.passed, result.summary());
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/math.h"

namespace tyndall::test {

using Uniform = std::function<float()>;  ///< an independent uniform number in [0, 1) at each call
/// Draws a unit direction, or nothing.
using DirectionSampler = std::function<std::optional<Vec3>(const Uniform&)>;
using DirectionDensity = std::function<double(Vec3)>;  ///< 1/sr; of a unit direction

struct ChiSquaredOptions {
  std::size_t samples = 200'000;
  int theta_bins = 24, phi_bins = 48;
  /// Pole of the bins. Put it on the peak of a narrow density.
  Vec3 axis{0, 0, 1};
  /// Bin edges lie at theta = pi (i / theta_bins)^theta_power: 1 = even; 2 to 4 gather the bins around the axis.
  double theta_power = 1;
  double alpha = 1e-4;  ///< probability of failing a correct sampler; sidak() shares one over a family of tests
  std::uint64_t seed = 1;
};

struct ChiSquaredResult {
  bool passed = false;
  double p_value = 0;
  double statistic = 0;
  int degrees_of_freedom = 0;
  double alpha = 0;
  double density_integral = 0;  ///< of the density over the sphere
  double sampled_fraction = 0;  ///< draws that gave a direction
  std::size_t impossible = 0;   ///< samples whose own density is not positive; one fails the test
  /// Probability-weighted rms of the bins' relative deviations that is found with power 0.99.
  double detectable_deviation = 0;

  std::string summary() const;  ///< one line for a failure message
};

/// Bins that expect fewer than 5 samples are pooled. Everything is deterministic in options.seed.
ChiSquaredResult chi_squared_test(const DirectionSampler& sample, const DirectionDensity& pdf,
                                  const ChiSquaredOptions& options = {});

/// Integral of `pdf` over the sphere by the same bins and quadrature.
double integrate_over_sphere(const DirectionDensity& pdf, const ChiSquaredOptions& options = {});

/// Level of each of `tests` independent tests for a family level `family_alpha` [Sidak 1967].
double sidak(double family_alpha, int tests);

/// p-value of Pearson's test that `counts` of `draws` outcomes follow the probabilities `pmf`. Outcomes expected fewer than 5
/// times are pooled, and left out where all of them together are; 1 when fewer than two are left to compare.
double count_p_value(const std::vector<double>& counts, const std::vector<double>& pmf, int draws);

/// Upper tail P(X > x) of the chi-squared distribution.
double chi_squared_tail(double x, double degrees_of_freedom);

/// Noncentrality at which a chi-squared test of level `alpha` rejects with probability `power`.
double detectable_noncentrality(double degrees_of_freedom, double alpha, double power);

/// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0.
double upper_gamma(double a, double x);

}  // namespace tyndall::test
