/// Are two noisy pictures of one scene the same picture [Jung et al. 2020, "Detecting Bias in Monte Carlo Renderers
/// using Welch's t-test"]?
#pragma once

#include <cstddef>
#include <vector>

#include "report/mean_image.h"

namespace tyndall {

/// One block of one channel.
struct BlockDifference {
  int x = 0, y = 0, channel = 0;  ///< block column and row
  WelchResult welch;
};

/// Welch's test on every block and channel of two images of equal size. Average pixels to blocks first (8 x 8, by
/// block_means): the test wants nearly normal means.
std::vector<BlockDifference> block_test(const MeanImage& a, const MeanImage& b);

/// The most significant of them; `differences` must not be empty.
const BlockDifference& worst(const std::vector<BlockDifference>& differences);

/// Number with p below `level`.
std::size_t count_below(const std::vector<BlockDifference>& differences, double level);

/// Welch's test on the mean over the whole picture of one channel.
WelchResult mean_test(const MeanImage& a, const MeanImage& b, int channel);

}  // namespace tyndall
