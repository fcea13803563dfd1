/// How far a picture is from a reference, in numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/stated_error.h"
#include "tyndall/image.h"

namespace tyndall {

/// Fraction of the pixels that a trimmed error leaves out: the worst ones, rounded down to whole pixels.
inline constexpr double kTrimmedFraction = 0.001;

/// Means over pixels and channels. With image x, reference r and eps = kRelativeEpsilon:
struct ErrorMetrics {
  double mse = 0;                        ///< (x - r)^2
  double relmse = 0;                     ///< (x - r)^2 / (r^2 + eps) [Rousselle et al. 2011]
  double relmse_trimmed = 0;             ///< relmse without the worst 0.1 % of pixels, by their mean over channels
  double mape = 0;                       ///< |x - r| / (|r| + eps)
  double smape = 0;                      ///< 2 |x - r| / (|x| + |r| + eps)
  std::optional<StatedErrors> stated{};  ///< what a denoised picture states of them; without the reference's noise only
};

/// Errors of R, G and B. Values that are not finite make the errors not finite. Throws Error: usage when the sizes
/// differ, scene when a channel is missing.
ErrorMetrics measure_error(const Image& image, const Image& reference);
/// The same over any channels that both images have.
ErrorMetrics measure_error(const Image& image, const Image& reference, const std::vector<std::string>& channels);

/// Whether the image has the variances of its R, G and B: those of a denoised one are of what was rendered, noisy.R and so on.
bool has_variances(const Image& image);

/// Errors of R, G and B with the reference's own noise taken off mse, relmse and relmse_trimmed: for independent
/// unbiased x and r, E[(x - r)^2] = E[(x - truth)^2] + Var(r). `reference` must have them (has_variances). What is left
/// has noise itself and may be slightly negative; the trimmed one a little too small, since pixels whose reference is
/// bad are among those left out.
ErrorMetrics measure_error_without_noise(const Image& image, const Image& reference);

/// relMSE of a render as estimated from its own noise: mean of Variance / (mean^2 + eps) over pixels and R, G, B, mean^2
/// less the Variance that is in it.
double relmse_by_variances(const Image& image);

/// Mean without the largest `fraction` of the values, rounded down to whole ones.
double trimmed_mean(std::vector<double> values, double fraction);

/// The channel `name`; throws Error (scene) when it is absent.
const Channel& required_channel(const Image& image, const std::string& name);
/// Throws Error (usage) unless both images have the same pixels: equal data windows in size.
void require_same_size(const Image& a, const Image& b);

}  // namespace tyndall
