/// What a filter must not lose: the light of a picture's parts.
#pragma once

#include <vector>

#include "denoise/light.h"

namespace tyndall {

/// The light of blocks of 64x64 pixels as rendered, and its variance.
class Energy {
 public:
  explicit Energy(const Halves& halves);

  /// Adds what is missing, or takes away, smoothly from block to block and where the noise is, until the picture and its blocks
  /// deviate from what was rendered by no more than the standard error of that: fireflies are in it, and one of them alone
  /// gives no reason to change anything.
  void restore(ColorPlanes& estimate, const ColorPlanes& variance, ThreadPool& pool) const;

 private:
  struct Block {
    double light = 0, variance = 0;
  };
  /// By block: what is to be added, and where.
  struct Change {
    const std::vector<double>&lights, &rooms;
  };
  static std::vector<double> missing_light(std::vector<double> lights, const std::vector<double>& rooms,
                                           const std::vector<Block>& blocks, bool blocks_too);
  std::size_t block_of(int x, int y) const;
  std::vector<double> sums_of(const PaddedPlane& plane) const;
  void add(PaddedPlane& estimate, const PaddedPlane& room, const Change& change, ThreadPool& pool) const;
  double bilinear(const std::vector<double>& blocks, int x, int y) const;

  int width_, height_, across_, down_;
  std::array<std::vector<Block>, 3> blocks_;  ///< by channel
};

}  // namespace tyndall
