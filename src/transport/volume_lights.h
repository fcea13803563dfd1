/// The media of a world that emit, as lights.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "light/lights.h"
#include "surface/geometry.h"
#include "volume/emissive_bricks.h"

namespace tyndall {

/// A brick that a ray passes.
struct VolumeOnRay {
  LightId light;
  float radiance;   ///< radiance that it sends along the ray, roughly; mean of channels
  float direction;  ///< 1/sr: density of the ray's direction among those sampled toward the brick
};
using VolumesOnRay = SmallVector<VolumeOnRay, 16>;

/// Each brick of a medium that emits is a light, and the media's lights follow each other. A direction toward one is
/// that of a point drawn in it.
class VolumeLights {
 public:
  VolumeLights() = default;
  /// Of the media that fill some space: the inside of a group, or `unbounded`.
  VolumeLights(const std::vector<ParticipatingMedium>& media, const std::vector<BoundaryGroup>& groups,
               std::optional<MediumId> unbounded);

  bool empty() const { return emissive_.empty(); }
  std::vector<VolumeEmitter> emitters() const;       ///< in the order of their ids; bricks beyond their groups have no power
  void set_first(LightId first) { first_ = first; }  ///< what the first of emitters() became

  bool holds(LightId light) const { return light - first_ < count_; }
  /// Unit direction from `p` toward a point of the light.
  Vec3 sample(LightId light, Vec3 p, Vec2 u) const;
  VolumesOnRay along(const Ray& ray) const;
  /// All volume emission as one place: what distances along a ray are drawn toward.
  const LightPlace& place() const { return place_; }
  std::size_t memory_bytes() const;
  /// One row for each medium that emits.
  std::vector<std::string> notes(const std::vector<Medium>& media) const;

 private:
  struct EmissiveMedium {
    std::size_t medium;
    LightId begin;  ///< of its lights, from first_ on
    EmissiveBricks bricks;
    Bounds3 reach;  ///< of the groups that bring the medium
  };
  const EmissiveMedium& medium_of(LightId light) const;

  std::vector<EmissiveMedium> emissive_;
  LightId first_ = 0, count_ = 0;
  LightPlace place_;
};

}  // namespace tyndall
