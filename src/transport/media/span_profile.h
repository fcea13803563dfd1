/// What the media along a span do, roughly: how much light is scattered where, and how much of it gets back to the
/// span's origin. It weights choices; no estimate is made from it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "light/segment_query.h"
#include "transport/media/span.h"

namespace tyndall {

/// Deterministic for a given span: MIS weights are made from it on both sides.
class SpanProfile {
 public:
  static constexpr std::size_t kMostBins = 32;
  enum class Bins : std::size_t { few = 16, many = kMostBins };
  static_assert(kMostBins % SegmentProfile::kBins == 0 && std::size_t(Bins::few) % SegmentProfile::kBins == 0);

  /// Nothing where the span's media do not scatter, or so little that it takes 1e18 units to see it.
  static std::optional<SpanProfile> of(const Span& span, Bins bins = Bins::many);

  std::size_t bins() const { return bins_; }     ///< a multiple of 8
  float begin() const { return edge_.front(); }  ///< distances between which light is scattered
  float end() const { return edge_[bins_]; }     ///< may be infinite
  /// end(), or as far as choices along a span without one need to look; beyond the last bin's begin.
  float finite_end() const { return end() < kInfinity ? end() : std::max(begin() + 2 * reach_, settled_); }
  std::span<const float> edges() const { return {edge_.data(), bins_ + 1}; }
  /// Mean of sigma_s x transmittance over each bin, 1/length; of the channels' means.
  std::span<const float> scatterings() const { return {scattering_.data(), bins_}; }
  std::span<const float> sigmas() const { return {sigma_t_.data(), bins_}; }  ///< extinction, likewise
  std::size_t bin_at(float t) const;                                          ///< that holds `t`, or is next to it
  /// From the origin to `t`.
  float transmittance(float t) const;
  float optical_depth() const { return depth_[bins_]; }  ///< of all of it
  /// Integral of sigma_s x transmittance: at most 1.
  float scattered() const { return scattered_; }
  /// Distance from begin() within which nearly all of that lies; finite.
  float reach() const { return reach_; }

  /// The same in fewer bins for the choice of a light; `g` is the phase function's mean cosine.
  SegmentProfile coarse(float g) const;

 private:
  using Edges = std::array<float, kMostBins + 1>;  ///< the first bins() + 1 count
  explicit SpanProfile(Bins bins) : bins_(static_cast<std::size_t>(bins)) {}
  void place_evenly(float begin, float end, float sigma_t);
  template <typename F>
  void place_by_looks(const F& optics, float begin, float end);
  void place_at_shares(std::span<const float> at, std::span<const float> cumulative);
  template <typename F>
  void fill(const F& optics);

  /// Optical depth at most from where it is `depth` to outside of the media, however lights lie around the span.
  float way_out(float depth) const;

  std::size_t bins_;
  Edges edge_{}, depth_{};
  std::array<float, kMostBins> scattering_{}, sigma_t_{};
  float scattered_ = 0, reach_ = 0;
  float settled_ = 0;                     ///< end(), or where a last bin without end is taken to be over
  bool enters_ = false, leaves_ = false;  ///< the media begin, end, on the span
};

}  // namespace tyndall
