/// The block test as it must be when noise is rare, lumpy or has long tails.
#pragma once

#include <vector>

#include "report/block_test.h"

namespace tyndall {

/// One block of one channel.
struct CautiousBlock {
  BlockDifference difference;  ///< with caution: p is what it says or too large
  double plain_p = 1;          ///< of Welch's test as it stands: more nearly uniform
};

/// Welch's test on the means of blocks of size x size pixels. A renderer knows a pixel's variance from two replicates,
/// one degree of freedom; the noise of a silhouette is hit or miss, so both may agree by chance while both are off.
/// Where a few pixels carry the noise of a block, Welch's test then reports 20 standard errors. Two measures:
/// - the variance of a block is at least a quarter of the mean over it and its eight neighbours;
/// - its degrees of freedom are not more than those of the pixels that carry its noise, found from all four replicates.
/// What they do to false alarms: docs/measurements.md. An eighth instead of a quarter did as well.
/// Price: a block that is quieter than its neighbours is tested as if its standard error were at least half of theirs.
/// Equal samples make a difference symmetric, and a firefly enlarges its own error: these need no measure.
std::vector<CautiousBlock> cautious_block_test(const MeanImage& a, const MeanImage& b, int size);

}  // namespace tyndall
