/// Colour of a black body, for the emission of hot media.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

/// Linear Rec.709 RGB of a black body at `kelvin`, as pbrt-v4's film (sensor "cie1931") shows it.
/// The spectrum is Planck's law divided by its peak (Wien), so only the hue and not T^4 depends on the
/// temperature; the result is the integral of colour matching functions times that spectrum over 360..830 nm,
/// not divided by the integral of ybar (about 106.86): at 6500 K all channels are near 100.
/// Smooth in `kelvin`; black at 0, for negative and for non-finite temperatures. Below about 1900 K black
/// bodies lie outside Rec.709 and blue is slightly negative: clamping it would shift the hue in wider spaces.
Rgb blackbody_rgb(float kelvin);

}  // namespace tyndall
