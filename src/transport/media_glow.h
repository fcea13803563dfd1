/// Where media send much light from, roughly: what rays from surfaces are worth being sent to.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "light/lights.h"
#include "surface/geometry.h"
#include "transport/fire_lights.h"
#include "volume/medium.h"

namespace tyndall {

/// Media that are not the same everywhere, as a few spheres that glow by scattering the light of all lamps, none of them in
/// another's way, and by being hot. It weights choices; no estimate is made from it.
class MediaGlow {
 public:
  static constexpr std::size_t kMostCells = 64;
  /// Its numbers stand in arrays, for several cells at once; those beyond size() are of cells without light.
  template <typename T>
  using PerCell = std::array<T, kMostCells>;

  MediaGlow() = default;
  struct Surroundings {
    const std::vector<BoundaryGroup>& groups;
    std::optional<MediumId> unbounded;
    const Lights& lights;
    const FireLights& fire;
    Bounds3 scene;  ///< encloses what lights shine on
  };
  /// Of the media that fill some space: the inside of a group, or the unbounded one.
  MediaGlow(const std::vector<ParticipatingMedium>& media, const Surroundings& around);

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  /// At `p`, of all lamps together as if nothing were in between; of the order of what surfaces around have to send on.
  float lamplight(Vec3 p) const;

  const PerCell<float>& x() const { return x_; }
  const PerCell<float>& y() const { return y_; }
  const PerCell<float>& z() const { return z_; }
  const PerCell<float>& radius() const { return radius_; }
  const PerCell<float>& radiance() const { return radiance_; }  ///< seen from outside, mean of the channels

 private:
  std::size_t size_ = 0;
  alignas(32) PerCell<float> x_{}, y_{}, z_{}, radius_{}, radiance_{};
  Bounds3 lamps_;
  float near_power_ = 0, far_light_ = 0;
};

}  // namespace tyndall
