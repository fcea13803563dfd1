/// How near lamps are to places in media, roughly: for choosing and never for estimating.
#pragma once

#include <optional>
#include <vector>

#include "light/lights.h"
#include "math/cubes.h"
#include "transport/fire_lights.h"
#include "transport/media/media_state.h"

namespace tyndall {

class NearLamps {
 public:
  /// A sphere that holds all of it.
  struct Lamp {
    Vec3 center;
    float radius;
  };

  NearLamps() = default;
  /// For places in `box`, which is finite and not empty. Without lamps they are at infinity.
  NearLamps(const Bounds3& box, const std::vector<Lamp>& lamps);

  bool empty() const { return !cubes_; }  ///< it knows of no place
  /// From `p` to the nearest lamp, about, less what may be the size of a cube; outside of the box also less the way there. 0
  /// within lamps.
  float distance(Vec3 p) const;

 private:
  Bounds3 box_;
  std::optional<Cubes> cubes_;
  std::vector<float> distances_;  ///< by cube
};

/// For places in media that fill some bounded space, which do not count as lamps where they glow. Of lamps by the million, some
/// stand for all.
NearLamps near_lamps(const std::vector<ParticipatingMedium>& media, const std::vector<BoundaryGroup>& groups,
                     std::optional<MediumId> unbounded, const Lights& lights, const FireLights& fire);

}  // namespace tyndall
