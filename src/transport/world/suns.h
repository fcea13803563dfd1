/// The suns of a scene, around which media spread light.
#pragma once

#include <vector>

#include "light/lights.h"
#include "transport/world/near_fluence.h"

namespace tyndall {

class Suns {
 public:
  Suns() = default;
  explicit Suns(const Lights& lights);

  bool empty() const { return brightest_.empty(); }
  /// As many as an Aureole takes.
  const std::vector<FarCone>& brightest() const { return brightest_; }
  /// Fluence of all other light at `p`, roughly.
  float others_at(Vec3 p) const { return far_ + near_.at(p); }

 private:
  std::vector<FarCone> brightest_;
  float far_ = 0;  ///< fluence of the other lights at infinity
  NearFluence near_;
};

}  // namespace tyndall
