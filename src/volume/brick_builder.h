/// Fills a BrickGrid from a VoxelSource.
#pragma once

#include <cstddef>
#include <limits>

#include "volume/brick_grid.h"

namespace tyndall {

struct BrickBuildOptions {
  VoxelRules rules;
  bool float_bricks = false;
  std::size_t most_memory = std::numeric_limits<std::size_t>::max();  ///< bytes of the grid
};

/// Thrown where the grid would take more than BrickBuildOptions::most_memory: how many bricks there are is known by making
/// them only. The faces of a box of one value are bricks as well, and so are up to eight around every lonely voxel.
struct GridTooLarge {};

/// Voxels are stored as 16-bit steps of their brick's range (error below 2^-16 of it, 0 stays exactly 0) or as floats.
/// Ranges in the hierarchy are those of the decoded values, widened by a few units in the last place so that they
/// hold for the rounding of the interpolation too.
BrickGrid build_brick_grid(const VoxelSource& source, const BrickBuildOptions& options);

}  // namespace tyndall
