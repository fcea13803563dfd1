/// Radiative transfer that is known in closed form or by quadrature.
#pragma once

#include <cmath>

#include "support/scene_text.h"
#include "tyndall/math.h"

namespace tyndall::test {

/// Integral of f over [a, b] by Gauss-Legendre rules of 8 points on `panels` equal parts.
template <typename Function>
double integrate(const Function& f, double a, double b, int panels);

/// Radiance / (sigma_s I) along a ray from o in an infinite homogeneous medium, scattered once and isotropically from
/// a point light `d` along the ray and `h` beside it:  1/4pi int_0^inf exp(-sigma_t (t + r)) / r^2 dt.
double single_scattering(double sigma_t, double h, double d);

/// Chandrasekhar's H function for isotropic scattering of albedo w < 1. Half-space, uniform radiance 1 from outside:
/// the emergent radiance is 1 - H(mu) sqrt(1 - w).
double chandrasekhar_h(double w, double mu);

/// Optical depth at sigma_t = 1 along a ray through a grid of cell-centred samples, trilinear; samples outside the bounds are
/// 0, and there is nothing at all out there.
double optical_depth(const Grid& grid, const Ray& ray, double t0, double t1);
/// What exp(-depth) may be off by, as voxels are stored in steps of 2^-16 of their brick's range.
inline double rounding_of_voxels(double depth) { return 0x1p-16 * depth * std::exp(-depth); }

// ---------------------------------------------------------------------------------------------------------

template <typename Function>
double integrate(const Function& f, double a, double b, int panels) {
  constexpr double kNodes[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double kWeights[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  const double half = (b - a) / panels / 2;
  double sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double middle = a + half * (2 * i + 1);
    for (int k = 0; k < 4; ++k) sum += kWeights[k] * (f(middle - half * kNodes[k]) + f(middle + half * kNodes[k]));
  }
  return sum * half;
}

}  // namespace tyndall::test
