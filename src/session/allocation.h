/// How many samples each part of a picture should have.
#pragma once

#include <span>
#include <vector>

#include "tyndall/math.h"

namespace tyndall {

/// What is known of a block of pixels.
struct BlockNoise {
  double error = 0;   ///< sum over its pixels of their relative variance
  double pixels = 0;  ///< in the block
};

/// Over all pixels.
double mean_error(std::span<const BlockNoise> blocks);
/// That of a block, number `at`, and the eight around it, weighted 4, 2 and 1 by distance. By itself a block would have few
/// degrees of freedom.
double pooled_error(std::span<const BlockNoise> blocks, int across, int at);
/// The same of each block.
std::vector<double> errors_around(std::span<const BlockNoise> blocks, int across);
/// The largest of these.
double worst_error(std::span<const BlockNoise> blocks, int across);

/// Below which errors shall be.
struct ErrorGoal {
  double mean = kInfinity;   ///< mean_error()
  double worst = kInfinity;  ///< worst_error()
};

/// A block that is to have samples.
struct BlockShare {
  double amount = 0;        ///< in proportion to which
  double work = 0;          ///< of a sample of all its pixels, in any unit
  int least = 2, most = 2;  ///< samples a pixel, even numbers
};

/// Samples a pixel for each block: even numbers, which together take as much work as `everywhere` samples of each, or less by
/// as little as even numbers allow.
std::vector<int> allot(std::span<const BlockShare> blocks, int everywhere);

}  // namespace tyndall
