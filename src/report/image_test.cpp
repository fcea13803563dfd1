#include "report/image_test.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "report/cautious_blocks.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Uniformity is judged by the smallest twentieth of p-values: differences of blocks that are hit or miss have few values,
/// so that larger p-values come in lumps, and small ones are rather too rare. A little more than a twentieth is allowed, for
/// what was measured (docs/measurements.md, false alarms).
constexpr double kSmall = 0.05, kSmallAllowed = 0.06;
/// Blocks of fewer degrees of freedom hardly ever have small p-values, and would dilute those of the others.
constexpr double kUniformityDof = 8;
constexpr int kParts = 3;  // blocks, means, uniformity
constexpr std::array<char, 3> kChannel{'R', 'G', 'B'};

void require_valid(const ImageTestSettings& settings) {
  if (!(settings.family_level > 0 && settings.family_level < 1)) {
    throw Error(Failure::usage, "the family level of an image test is a probability above 0 and below 1; 0.001 is usual");
  }
  if (settings.block_size < 1) throw Error(Failure::usage, "blocks of an image test have at least 1 pixel a side; 8 is usual");
}

std::size_t count_non_finite(const MeanImage& image) {
  std::size_t count = 0;
  for (const auto& channel : image.channels) {
    for (const Estimate& e : channel) count += !std::isfinite(e.mean) || !std::isfinite(e.variance);
  }
  return count;
}

/// Equal to the last bit: black in both, or one and the same render.
bool says_nothing(const CautiousBlock& block) { return block.difference.welch.t == 0 && block.plain_p == 1; }

void test_blocks(const std::vector<CautiousBlock>& blocks, ImageTest& test, double level) {
  std::vector<BlockDifference> differences;
  for (const CautiousBlock& b : blocks) {
    if (!says_nothing(b)) differences.push_back(b.difference);
  }
  test.blocks = differences.size();
  if (differences.empty()) return;
  test.block_level = sidak(level, static_cast<double>(differences.size()));
  test.alarms = count_below(differences, test.block_level);
  test.worst_block = worst(differences);
}

void test_means(const MeanImage& a, const MeanImage& b, ImageTest& test) {
  for (int k = 0; k < 3; ++k) {
    const WelchResult w = test.means[k] = mean_test(a, b, k);
    const double scale = std::abs(image_mean(b, k).mean);
    test.relative_bias[k] = w.difference == 0 ? 0 : w.difference / scale;
    test.relative_error[k] = w.standard_error == 0 ? 0 : w.standard_error / scale;
  }
}

/// Channels have their noise in common, so each is a test of its own.
void test_uniformity(const std::vector<CautiousBlock>& blocks, ImageTest& test) {
  for (int k = 0; k < 3; ++k) {
    std::size_t count = 0, small = 0;
    for (const CautiousBlock& b : blocks) {
      if (b.difference.channel != k || says_nothing(b) || b.difference.welch.dof < kUniformityDof) continue;
      ++count;
      small += b.plain_p < kSmall;
    }
    if (count == 0) continue;
    test.small_p[k] = static_cast<double>(small) / static_cast<double>(count);
    test.uniformity_p[k] = binomial_tail(count, kSmallAllowed, small);
  }
}

template <typename... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

std::string block_text(const ImageTest& test) {
  const BlockDifference& w = test.worst_block;
  return text("%zu of %zu blocks off", test.alarms, test.blocks) +
         text(", worst %c of block (%d, %d): %+.1f standard errors, p = %.1e", kChannel[w.channel], w.x, w.y, w.welch.t,
              w.welch.p);
}

std::string mean_text(const ImageTest& test, int k) {
  return text("%c %+.3f %% +- %.3f %%", kChannel[k], 100 * test.relative_bias[k], 196 * test.relative_error[k]);
}

void judge(ImageTest& test) {
  std::string reasons;
  const auto add = [&](const std::string& reason) { reasons += (reasons.empty() ? "" : "; ") + reason; };
  if (test.non_finite > 0) add(text("%zu values are not finite", test.non_finite));
  if (test.alarms > 0) add(block_text(test));
  for (int k = 0; k < 3; ++k) {
    if (!(test.means[k].p >= test.mean_level)) add("mean " + mean_text(test, k) + text(" (p = %.1e)", test.means[k].p));
  }
  for (int k = 0; k < 3; ++k) {
    if (!(test.uniformity_p[k] >= test.uniformity_level)) {
      add(text("small differences of %c in many blocks: %.0f %% of them have p < %g (p = %.1e)", kChannel[k],
               100 * test.small_p[k], kSmall, test.uniformity_p[k]));
    }
  }
  test.same = reasons.empty();
  if (!test.same) {
    test.verdict = "differs: " + reasons;
  } else {
    test.verdict =
        (test.blocks == 0 ? "same: every block equal, mean " : text("same: none of %zu blocks off, mean ", test.blocks)) +
        mean_text(test, 0) + ", " + mean_text(test, 1) + ", " + mean_text(test, 2);
  }
}

}  // namespace

ImageTest test_images(const MeanImage& a, const MeanImage& b, const ImageTestSettings& settings) {
  require_valid(settings);
  ImageTest test;
  const double level = settings.family_level / kParts;
  test.mean_level = test.uniformity_level = sidak(level, 3);
  test.non_finite = count_non_finite(a) + count_non_finite(b);
  if (test.non_finite == 0) {
    const std::vector<CautiousBlock> blocks = cautious_block_test(a, b, settings.block_size);
    test_blocks(blocks, test, level);
    test_means(a, b, test);
    test_uniformity(blocks, test);
  }
  judge(test);
  return test;
}

}  // namespace tyndall
