/// Planck's law; its colour is blackbody_rgb in tyndall/color.h.
#pragma once

namespace tyndall {

/// Spectral radiance of a black body divided by its peak over all wavelengths, in [0,1]. 0 for kelvin <= 0.
double normalized_blackbody(double lambda_nm, double kelvin);

}  // namespace tyndall
