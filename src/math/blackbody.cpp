#include <cmath>

#include "math/blackbody.h"
#include "math/cie.h"
#include "tyndall/color.h"

namespace tyndall {

// B(lambda) = 2 h c^2 / (lambda^5 (exp(x) - 1)), x = h c / (lambda k T) [Planck]. Its peak lies where x = 4.965114
// [Wien's displacement law], whatever T, so B / B_peak = (x / x_peak)^5 (exp(x_peak) - 1) / (exp(x) - 1).
double normalized_blackbody(double lambda_nm, double kelvin) {
  constexpr double hc_over_k = 6.62606957e-34 * 299792458 / 1.3806488e-23 * 1e9;  // nm K
  constexpr double peak = hc_over_k / 2.8977721e6;
  if (!(kelvin > 0)) return 0;
  const double x = hc_over_k / (lambda_nm * kelvin);
  if (x > 700) return 0;  // exp(x) would overflow; the value is below 1e-290
  return std::pow(x / peak, 5) * std::expm1(peak) / std::expm1(x);
}

Rgb blackbody_rgb(float kelvin) {
  if (!std::isfinite(kelvin) || kelvin <= 0) return {};
  const auto& cmf = color_matching_functions();
  Xyz sum;
  for (int i = 0; i < kLambdaCount; ++i) sum = sum + normalized_blackbody(kLambdaMin + i, kelvin) * cmf[i];
  return to_rec709(sum);
}

}  // namespace tyndall
