/// The distance to the nearest light at places in media, roughly: for choices, never for estimates.
#pragma once

#include <optional>
#include <vector>

#include "light/lights.h"
#include "math/cubes.h"
#include "transport/media/media_state.h"
#include "transport/world/volume_lights.h"

namespace tyndall {

class LightDistances {
 public:
  /// A sphere that holds all of it.
  struct Near {
    Vec3 center;
    float radius;
  };

  LightDistances() = default;
  /// For places in `box`, which is finite and not empty. Without lights they are at infinity.
  LightDistances(const Bounds3& box, const std::vector<Near>& near);

  bool empty() const { return !cubes_; }  ///< no place is covered
  /// From `p` to the nearest light, about, less what may be the size of a cube; outside of the box also less the distance to
  /// it. 0 within lights.
  float distance(Vec3 p) const;

 private:
  Bounds3 box_;
  std::optional<Cubes> cubes_;
  std::vector<float> distances_;  ///< by cube
};

/// For places in media that fill some bounded space, which do not count as lights where they emit. Of millions of lights a
/// subset stands for all.
LightDistances light_distances(const std::vector<ParticipatingMedium>& media, const std::vector<BoundaryGroup>& groups,
                               std::optional<MediumId> unbounded, const Lights& lights, const VolumeLights& volume_lights);

}  // namespace tyndall
