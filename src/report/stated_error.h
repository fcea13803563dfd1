/// Whether a denoised picture is as wrong as it says: its Mse.R .G .B against a reference.
#pragma once

#include <optional>

#include "tyndall/image.h"

namespace tyndall {

/// What a picture states of its errors; ErrorMetrics::relmse without the reference's noise over `relmse` is 1 where that is
/// right.
struct StatedErrors {
  double relmse = 0;          ///< mean of Mse / (r^2 + eps), r the reference
  double relmse_trimmed = 0;  ///< without the 0.1 % of pixels where it is largest
  /// Fraction of the values with noise whose difference from the reference is within two standard errors: the root of Mse and
  /// of the reference's variance, that over 3x3 pixels since it has one degree of freedom a pixel. Normal errors: 0.954.
  double within_two = 0;
};

/// None for a picture that states no errors. `reference` must have R, G, B and Variance.R .G .B, and the same size.
std::optional<StatedErrors> stated_errors(const Image& image, const Image& reference);

}  // namespace tyndall
