/// Do two renders show the same picture, but for their noise?
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "report/block_test.h"

namespace tyndall {

struct ImageTestSettings {
  double family_level = 1e-3;  ///< chance of an alarm where there is no difference, over all parts of the test; (0, 1)
  int block_size = 8;          ///< pixels a side, >= 1; 64 pixels make a nearly normal mean
};

/// What was tested and found. A third of the family level each goes to blocks, means and uniformity.
struct ImageTest {
  bool same = false;    ///< no alarm of any kind
  std::string verdict;  ///< one line for people; its +- are 95 % intervals

  std::size_t blocks = 0;       ///< tested, over all channels; exactly equal ones, black in both say, tell nothing
  std::size_t alarms = 0;       ///< of them with p below block_level
  double block_level = 0;       ///< Sidak's, for `blocks` tests
  BlockDifference worst_block;  ///< the most significant one; x and y in blocks

  std::array<WelchResult, 3> means{};           ///< of the whole picture, by channel
  std::array<double, 3> relative_bias{};        ///< (mean a - mean b) / mean b; 0 when both are 0
  std::array<double, 3> relative_error{};       ///< one standard error of it
  double mean_level = 0;                        ///< of each of the three tests
  std::array<double, 3> small_p{};              ///< part of the blocks with p < 0.05, by channel
  std::array<double, 3> uniformity_p{1, 1, 1};  ///< that so many are by chance
  double uniformity_level = 0;                  ///< of each of the three tests

  std::size_t non_finite = 0;  ///< values or variances that are NaN or infinite; any is an alarm
};

/// The image test in three parts, each over R, G and B:
/// 1. Welch's test on the means of blocks [Jung et al. 2020] at Sidak's level: finds what is off in some place.
/// 2. Welch's test on the mean of the picture: finds a small bias that is everywhere.
/// 3. Are the blocks' p-values uniform? Too many below 0.05: finds small differences of either sign in many places.
///    Too few are no alarm: renders of equal seeds are closer than chance allows, and still equal.
/// `a` and `b` hold pixels, with the variances of their means. Noise with long tails: see cautious_blocks.h.
/// Throws Error (usage) when the sizes differ or a setting is out of its range.
ImageTest test_images(const MeanImage& a, const MeanImage& b, const ImageTestSettings& settings = {});

}  // namespace tyndall
