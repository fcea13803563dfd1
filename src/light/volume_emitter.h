/// A piece of a medium that emits, as far as lights know it: its points and directions need the medium.
#pragma once

#include "light/bounds.h"

namespace tyndall {

struct VolumeEmitter {
  Bounds3 box;
  float intensity;  ///< W/sr, mean of the channels: int sigma_a Le dV, comparable with a point light's I

  /// Emits from everywhere to everywhere.
  LightBounds bounds() const {
    return {.box = box, .normals = DirectionCone::everything(), .theta_e = kPi / 2, .intensity = intensity, .two_sided = false};
  }
  double power() const { return 4 * double{kPi} * intensity; }
};

}  // namespace tyndall
