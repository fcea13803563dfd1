/// Lights that all instances of an object have in common, as far as the choice among them is concerned.
#pragma once

#include <vector>

#include "light/light_tree.h"
#include "math/similarity.h"

namespace tyndall {

/// In the object's space, numbered from 0. Lights without power stand in `power` alone.
struct SharedLights {
  std::vector<double> power;  ///< W, by number
  std::vector<TreeLight> near;
};

struct LightInstance {
  std::uint32_t object;
  LightId first;        ///< light of the instance; that with number i is first + i
  Similarity to_world;  ///< from the object's space
  double growth = 1;    ///< its power over that in the object's space
};

/// Bounds in the outer space, the box as loose as turned boxes are; the intensity times `growth`.
LightBounds placed(const LightBounds& bounds, const Similarity& to_outer, double growth);
Bounds3 placed(const Bounds3& box, const Similarity& to_outer);

}  // namespace tyndall
