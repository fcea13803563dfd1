/// How alike two pixels are by the patches around them, in units of their noise [Buades et al. 2005; Rousselle et al. 2012].
#pragma once

#include <span>
#include <vector>

#include "denoise/plane.h"

namespace tyndall {

/// A picture that tells which pixels belong together; the variance of each value is `scale` times what `variances` hold. One to
/// three channels.
struct Guide {
  std::vector<const PaddedPlane*> values, variances;
  float scale = 1;
};

/// Pixels (2 radius + 1)^2 around each centre, row by row, padded to full SIMD vectors.
struct Neighbourhood {
  int radius;

  int side() const { return 2 * radius + 1; }
  int count() const { return side() * side(); }
  int padded() const { return (count() + 7) / 8 * 8; }
};

/// The centres of a tile: (x0 + i step, y0 + j step) for i < across, j < down.
struct CentreGrid {
  int x0, y0, step, across, down;

  int count() const { return across * down; }
  int x(int centre) const { return x0 + centre % across * step; }
  int y(int centre) const { return y0 + centre / across * step; }
};

/// For each centre the distances to its neighbours, `Neighbourhood::padded()` floats a centre: 0 in expectation for pixels that
/// differ by noise alone, kFar for those outside the picture.
class PatchDistances {
 public:
  static constexpr float kFar = 1e4f;

  PatchDistances(Neighbourhood neighbourhood, int patch_radius) : neighbourhood_(neighbourhood), patch_(patch_radius) {}

  void compute(const Guide& guide, const CentreGrid& centres);

  /// exp(-max(d, 0) / k^2), 0 from exp(-16) on; `weights` has room for `padded()`.
  void weights(int centre, float k, std::span<float> weights) const;

 private:
  void pixel_distances(const Guide& guide, int dx, int dy, const CentreGrid& centres);
  void sum_patches(int offset, const CentreGrid& centres);
  void mark_outside(const Guide& guide, const CentreGrid& centres);

  Neighbourhood neighbourhood_;
  int patch_;
  int row_ = 0;                   ///< floats a row of pixels_, whole vectors
  std::vector<float> pixels_;     ///< distances of single pixels, for one offset: the tile and a patch's radius around it
  std::vector<float> columns_;    ///< their sums over a patch's rows, for one row of centres
  std::vector<float> distances_;  ///< of patches
};

}  // namespace tyndall
