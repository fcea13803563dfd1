/// How many samples each part of a picture should have.
#pragma once

#include <span>
#include <vector>

#include "tyndall/math.h"

namespace tyndall {

/// What is known of a block of pixels.
struct BlockNoise {
  double error = 0;   ///< over its pixels, the sum of the relative variance of one sample
  double pixels = 0;  ///< in the block
  double work = 0;    ///< of a sample of all of them, in any unit
  int samples = 0;    ///< of each pixel, so far
};

/// Over all pixels, of the relative variance with the samples that they have.
double mean_error(std::span<const BlockNoise> blocks);
/// The same of each block with those around it, as pooled_error() weights them.
std::vector<double> errors_around(std::vector<BlockNoise> blocks, int across);
/// The largest of these.
double worst_error(std::vector<BlockNoise> blocks, int across);

/// The mean over a block, number `at`, and the eight around it, weighted 4, 2 and 1 by distance, of the relative variance of
/// one sample of a pixel. By itself a block would have few degrees of freedom, and its samples would decide their own number.
double pooled_error(std::span<const BlockNoise> blocks, int across, int at);

/// Below which errors shall be.
struct ErrorGoal {
  double mean = kInfinity;   ///< mean_error()
  double worst = kInfinity;  ///< worst_error()
};

struct SampleBudget {
  double mean = 0;  ///< samples a pixel of the frame
  int most = 0;     ///< samples that any pixel may have
  ErrorGoal goal{};
};

/// Samples for each block, an even number, at least as many as it has, in the mean over pixels as the budget says: in
/// proportion to sqrt(error / work), which makes the sum of error / samples least for the work it takes [Cochran 1977, 5.5].
/// At least a quarter of the mean, so that what was missed can still be found, and at most four times what the block has, so
/// that what was seen by chance is not taken for sure.
/// With a goal for the worst error each block gets at least what that takes, error / goal, which keeps the above a least under
/// this constraint. Where the budget is too small for that, or nothing but that is missing, in proportion to the error alone,
/// which makes the largest one least.
std::vector<int> allot(std::span<const BlockNoise> blocks, int across, const SampleBudget& budget);

}  // namespace tyndall
