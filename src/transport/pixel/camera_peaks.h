/// Direct light of surfaces that point and spot lights stand close to, whose film position is drawn for the light.
///
/// As camera_joint.h does in media: each sample of a pixel that sees such a place (peaks.h) also takes a film position near it,
/// weighted by MIS, light by light, against the filter's.
#pragma once

#include "transport/pixel/film_search.h"
#include "transport/pixel/peaks.h"
#include "transport/techniques/mis.h"

namespace tyndall {

/// Of point and spot lights that the camera sees stand lower above a surface than a pixel is wide there. None where settings
/// or the camera rule it out: only cameras that see sharply find them.
FilmPeaks film_peaks(const FilmSearch& search);

/// Unbiased estimate, for the pixel at `center`, of the share of the direct light of the surfaces that the camera sees which
/// PeakWeight::path_mis_weight does not leave to the filter's samples. `peaks`, the pixel's, must not be empty.
Rgb peak_estimate(const LightContext& context, const PixelPeaks& peaks, Vec2 center, Sampler sampler);

/// The camera's ray that a pixel's filter has drawn.
class PeakWeight final : public JointWeight {
 public:
  /// Through film position `x`, drawn with density `pdf` in 1/pixels^2. `peaks` must outlive it.
  PeakWeight(const PixelPeaks& peaks, Vec2 x, float pdf) : peaks_(peaks), x_(x), pdf_(pdf) {}
  float path_mis_weight(const LightContext&, LightId light) const override { return mis_weight(pdf_, peaks_.pdf(light, x_)); }

 private:
  const PixelPeaks& peaks_;
  Vec2 x_;
  float pdf_;
};

}  // namespace tyndall
