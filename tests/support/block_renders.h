/// Independent renders of one scene as means over blocks of pixels.
#pragma once

#include <cstdint>

#include "support/measure.h"

namespace tyndall::test {

/// Means over blocks, whose errors are their spread between 24 renders.
struct BlockRenders {
  MeanImage blocks;
  double pixel_variance = 0;  ///< of one render, the sum over pixels in green
};

/// Of blocks of `side` x `side` pixels; seeds go on from `seed`. Faults of the renders fail the test.
BlockRenders block_renders(Subject subject, int side, int spp, std::uint64_t seed);

}  // namespace tyndall::test
