/// FLIP: the difference that a person sees when two pictures alternate on a display
/// [Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images"; for high dynamic range Andersson et al.
/// 2021, "Visualizing Errors in Rendered High Dynamic Range Images"]. Written from the papers.
#pragma once

#include <vector>

#include "tyndall/image.h"

namespace tyndall {

struct FlipSettings {
  /// Pixels in a degree of the visual field, > 0. The default is the papers': a 3840-pixel display of 0.7 m from 0.7 m.
  double pixels_per_degree = 67.0206432765823;
};

/// Differences of pixels, row by row, in [0, 1]: 0 is the same.
struct FlipMap {
  std::vector<float> values;
  double mean() const;  ///< the one number to quote, as the authors advise

  // HDR only: the exposures compared, in stops, and how many.
  double start_exposure = 0, stop_exposure = 0;
  int exposures = 0;
};

/// LDR-FLIP of R, G and B (linear Rec.709) as displayed at exposure 0: values beyond [0, 1] are clamped.
/// Throws Error: usage when the sizes differ, scene when a channel is missing. Values must be finite.
FlipMap flip_ldr(const Image& image, const Image& reference, const FlipSettings& settings = {});

/// HDR-FLIP: the largest LDR-FLIP over exposures, a stop or a little less apart, from the one that shows the brightest
/// pixel of the reference to the one that shows its median (of the pixels that are not black, where most are), both
/// through the ACES curve. Negative values are taken for 0.
FlipMap flip_hdr(const Image& image, const Image& reference, const FlipSettings& settings = {});

}  // namespace tyndall
