/// What the media along a span do, roughly: how much light is scattered where, and how much of it gets back to the
/// span's origin. It weights choices; no estimate is made from it.
#pragma once

#include <array>
#include <optional>

#include "light/segment_query.h"
#include "render/span.h"

namespace tyndall {

/// Deterministic for a given span: MIS weights are made from it on both sides.
class SpanProfile {
 public:
  /// With 24 and as many fewer first looks, the variance in dense smoke is a third higher, with 48 no lower.
  static constexpr int kBins = 32;
  static_assert(kBins % SegmentProfile::kBins == 0);

  /// Nothing where the span's media do not scatter, or so little that it takes 1e18 units to see it.
  static std::optional<SpanProfile> of(const Span& span);

  float begin() const { return edge_.front(); }  ///< distances between which light is scattered
  float end() const { return edge_.back(); }     ///< may be infinite
  const std::array<float, kBins + 1>& edges() const { return edge_; }
  /// Mean of sigma_s x transmittance over each bin, 1/length; of the channels' means.
  const std::array<float, kBins>& scatterings() const { return scattering_; }
  const std::array<float, kBins>& sigmas() const { return sigma_t_; }  ///< extinction, likewise
  /// From the origin to `t`.
  float transmittance(float t) const;
  float optical_depth() const { return depth_.back(); }  ///< of all of it
  /// Integral of sigma_s x transmittance: at most 1.
  float scattered() const { return scattered_; }
  /// Distance from begin() within which nearly all of that lies; finite.
  float reach() const { return reach_; }

  /// The same in fewer bins for the choice of a light; `g` is the phase function's mean cosine.
  SegmentProfile coarse(float g) const;

 private:
  SpanProfile() = default;
  template <typename F>
  void fill(const F& optics);

  /// Optical depth at most from where it is `depth` to outside of the media, however lights lie around the span.
  float way_out(float depth) const;

  std::array<float, kBins + 1> edge_{}, depth_{};
  std::array<float, kBins> scattering_{}, sigma_t_{};
  float scattered_ = 0, reach_ = 0;
  bool enters_ = false, leaves_ = false;  ///< the media begin, end, on the span
};

}  // namespace tyndall
