/// Cones of directions that bound normals and emission.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

/// All unit vectors within the angle `theta` of `axis`. Angles, not cosines: they stay exact for narrow cones.
struct DirectionCone {
  Vec3 axis{0, 0, 1};
  float theta = -1;  ///< [0, pi]; negative: the empty cone

  static DirectionCone around(Vec3 axis, float theta = 0) { return {axis, theta}; }
  static DirectionCone everything() { return {{0, 0, 1}, kPi}; }
  bool empty() const { return theta < 0; }
  bool full() const { return theta >= kPi; }
};

/// Angle between unit vectors in [0, pi], accurate for nearly equal and opposite ones too [Kahan 2006].
double angle_between(Vec3 a, Vec3 b);

/// A cone that contains both, widened by no more than rounding [Conty Estevez and Kulla 2018, algorithm 1].
DirectionCone cone_union(const DirectionCone& a, const DirectionCone& b);

}  // namespace tyndall
