/// Where media scatter or emit much light, roughly: what rays from surfaces are worth being sent to.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "light/lights.h"
#include "surface/geometry.h"
#include "transport/world/near_fluence.h"
#include "transport/world/volume_lights.h"
#include "volume/medium.h"

namespace tyndall {

/// Heterogeneous media as a few spheres that radiate by scattering the light of all lights, without shadows, and by volume
/// emission. It weights choices; no estimate is made from it.
class BrightMedia {
 public:
  static constexpr std::size_t kMostCells = 64;
  /// Its numbers are in arrays, for several cells at once; those beyond size() are of cells without light.
  template <typename T>
  using PerCell = std::array<T, kMostCells>;

  BrightMedia() = default;
  struct Surroundings {
    const std::vector<BoundaryGroup>& groups;
    std::optional<MediumId> unbounded;
    const Lights& lights;
    const VolumeLights& volume_lights;
    Bounds3 scene;  ///< encloses what lights illuminate
  };
  /// Of the media that fill some space: the inside of a group, or the unbounded one.
  BrightMedia(const std::vector<ParticipatingMedium>& media, const Surroundings& around);

  bool empty() const { return size_ == 0; }
  float emission_share() const { return emission_share_; }  ///< of the radiance, that is volume emission
  std::size_t size() const { return size_; }
  /// Fluence at `p` of all lights together without visibility; of the order of what surfaces around scatter.
  float in_scattered(Vec3 p) const;

  const PerCell<float>& x() const { return x_; }
  const PerCell<float>& y() const { return y_; }
  const PerCell<float>& z() const { return z_; }
  const PerCell<float>& radius() const { return radius_; }
  const PerCell<float>& radiance() const { return radiance_; }  ///< seen from outside, mean of the channels

 private:
  std::size_t size_ = 0;
  float emission_share_ = 0;
  alignas(32) PerCell<float> x_{}, y_{}, z_{}, radius_{}, radiance_{};
  NearFluence near_fluence_;
  float far_light_ = 0;
};

}  // namespace tyndall
