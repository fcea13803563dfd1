/// A light as the construction of the wide tree stores it.
#pragma once

#include <cstdint>

#include "light/light_tree.h"

namespace tyndall {

/// A light while the tree is built, lengths in the tree's unit: fourteen words, so that two loads of eight read all that splits
/// need.
struct BuildLight {
  float low[3], minus_high[3];  ///< box
  float axis[3];
  float theta_o, theta_e;
  float cos_reach;  ///< of the angle that the normals' cone and most of the emission reach, see wide_buckets.cpp
  float intensity;  ///< relative to that of all lights
  std::uint32_t light : 31;
  std::uint32_t two_sided : 1;

  static BuildLight from(const TreeLight& light, double to_unit, double intensity);
  LightBounds bounds() const;
};

}  // namespace tyndall
