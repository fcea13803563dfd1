/// How the lights of a wide node are divided among its children: the surface area orientation heuristic on buckets.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "light/light_tree.h"

namespace tyndall {

/// A light while the tree is built, lengths in the tree's unit: fourteen words, so that two loads of eight bring all
/// that splits look at.
struct BuildLight {
  float low[3], minus_high[3];  ///< box
  float axis[3];
  float theta_o, theta_e;
  float cos_reach;  ///< of the angle that the normals' cone and most of the emission reach, see wide_split.cpp
  float intensity;  ///< relative to that of all lights
  std::uint32_t light : 31;
  std::uint32_t two_sided : 1;

  static BuildLight from(const TreeLight& light, double to_unit, double intensity);
  LightBounds bounds() const;
};

/// Lights per child in order, of a node; 0: no such child.
using Division = std::array<std::uint32_t, 8>;

/// Reorders the lights so that the children's are consecutive.
Division divide(std::span<BuildLight> lights);

}  // namespace tyndall
