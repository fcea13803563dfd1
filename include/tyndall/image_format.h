/// How image files are written: numbers and packing of an .exr, the look of a .png.
#pragma once

#include <string_view>
#include <vector>

#include "tyndall/math.h"

namespace tyndall {

/// Packing of OpenEXR files. All but dwaa and dwab, which keep what the eye sees, keep every bit.
enum class ExrCompression { none, rle, zips, zip, piz, dwaa, dwab };
constexpr bool is_lossy(ExrCompression c) { return c == ExrCompression::dwaa || c == ExrCompression::dwab; }

struct ExrSettings {
  /// Colours as 16-bit floats: 11 bits of precision, 65504 at most, to which larger values are clamped. Positions, depths,
  /// counts, variances and what denoising needs stay 32-bit floats.
  bool half = false;
  ExrCompression compression = ExrCompression::zip;
  /// A part of the file for each group of channels ("rgba", "Albedo" ...), so that readers load only what they show.
  bool parts = false;
};

/// From light to what a display shows.
///   srgb     clipped at 1, then the sRGB curve [IEC 61966-2-1]
///   filmic   f(2x) / f(11.2), f(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F, with A..F = 0.15, 0.5, 0.1, 0.2,
///            0.02, 0.3 for each channel, then the sRGB curve [Hable 2010, "Filmic Tonemapping Operators"]
///   agx      colours drawn toward grey by a matrix, log2 over 16.5 stops about 0.18, a sigmoid, the matrix undone [Sobotka
///            2022, "AgX"], the sigmoid by the polynomial of degree 6 of [Wrensch 2023, "Minimal AgX Implementation"]
enum class DisplayView { srgb, filmic, agx };

struct PngSettings {
  float exposure = 0;  ///< stops
  DisplayView view = DisplayView::srgb;
};

/// What a file is written with, whichever it is by its ending.
struct ImageFormat {
  ExrSettings exr;
  PngSettings png;
};

/// What a display is sent, in [0, 1], for linear Rec.709. NaN counts as 0.
Rgb displayed(Rgb light, DisplayView view);

/// Names in the order of their enums.
const std::vector<std::string_view>& exr_compression_names();
const std::vector<std::string_view>& view_names();

}  // namespace tyndall
