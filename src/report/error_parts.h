/// Which light a picture's error is made of.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// Channels that add up to a picture, but for their .R .G .B.
inline constexpr std::array kLightParts{"Emission", "SurfaceDirect", "SurfaceIndirect", "VolumeDirect", "VolumeIndirect"};

/// Variances of the parts from one seed's picture to the next, relative to the reference as relMSE is. Parts that are bright in
/// the same samples make more of the picture's error than they tell, and less where one is bright as the other is dark.
class ErrorParts {
 public:
  using Shares = std::array<double, kLightParts.size()>;  ///< fractions of 1, by kLightParts

  /// `reference` must outlive this.
  explicit ErrorParts(const Image& reference) : reference_(&reference) {}

  /// Of the next seed, with all parts and the reference's pixels. An image without channels, of a method that was given up, is
  /// left out.
  void add(const Image& image);
  /// Nothing from a single picture, or where pictures do not differ.
  std::optional<Shares> shares() const;

 private:
  const Image* reference_;
  std::vector<std::vector<float>> before_;  ///< of the seed before: part by part R, G, B
  Shares variances_{};                      ///< not divided by what is the same for all
};

}  // namespace tyndall
