/// Gradient noise, of procedural clouds and textures.
#pragma once

#include "math/simd.h"
#include "tyndall/math.h"

namespace tyndall {

/// A cell of the lattice between whose corners' gradients the noise lies.
class NoiseCell {
 public:
  explicit NoiseCell(Vec3 p);

  bool holds(Vec3 p) const;
  /// The noise at a point that it holds.
  float at(Vec3 p) const;

 private:
  Vec3 corner_;  ///< whole numbers
  // Of the gradients at eight corners, the two coordinates that aren't 0.
  Mask8 first_is_x_, second_is_y_;  ///< or y, and z
  Float8 first_sign_, second_sign_;
};

/// Perlin's improved gradient noise [Perlin 2002] with his permutation, repeating every 256 units; in about [-1, 1].
inline float perlin_noise(Vec3 p) { return NoiseCell(p).at(p); }

}  // namespace tyndall
