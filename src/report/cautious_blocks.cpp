#include "report/cautious_blocks.h"

#include <algorithm>
#include <cmath>

#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Part of the neighbourhood's variance that a block has at least.
constexpr double kBorrowed = 0.25;

/// `blocks` with variances raised to what their neighbours suggest.
MeanImage with_borrowed_variance(const MeanImage& blocks) {
  MeanImage result = blocks;
  for (int channel = 0; channel < 3; ++channel) {
    for (int y = 0; y < blocks.height; ++y) {
      for (int x = 0; x < blocks.width; ++x) {
        double sum = 0;
        int count = 0;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, blocks.height - 1); ++j) {
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, blocks.width - 1); ++i, ++count) {
            sum += blocks.at(i, j, channel).variance;
          }
        }
        double& variance = result.channels[channel][static_cast<std::size_t>(y) * blocks.width + x].variance;
        variance = std::max(variance, kBorrowed * sum / count);
      }
    }
  }
  return result;
}

/// Degrees of freedom that a block of the difference a - b can have at most: those of a pixel, times the number of
/// pixels that carry the noise, (sum w)^2 / sum w^2. Of pixel i the variance is estimated by w = (va + vb + (a - b)^2) / 2,
/// which sees what two replicates that agree by chance hide. The scatter of w itself makes the number smaller, of 64
/// alike pixels 37: that is left as it is, and costs little so far above one.
double largest_dof(const MeanImage& a, const MeanImage& b, int channel, const PixelBounds& block) {
  double sum = 0, squares = 0, dof = 0;
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) {
      const Estimate &in_a = a.at(x, y, channel), &in_b = b.at(x, y, channel);
      const double d = in_a.mean - in_b.mean, w = (in_a.variance + in_b.variance + d * d) / 2;
      sum += w;
      squares += w * w;
      dof += in_a.dof + in_b.dof;
    }
  }
  if (!(squares > 0)) return dof;
  return sum * sum / squares * dof / (static_cast<double>(block.width()) * block.height());
}

}  // namespace

std::vector<CautiousBlock> cautious_block_test(const MeanImage& a, const MeanImage& b, int size) {
  if (a.width != b.width || a.height != b.height) {
    throw Error(Failure::usage, "images of different sizes cannot be tested; render them at one resolution");
  }
  const MeanImage blocks_a = block_means(a, size), blocks_b = block_means(b, size);
  const std::vector<BlockDifference> plain = block_test(blocks_a, blocks_b);
  const std::vector<BlockDifference> raised = block_test(with_borrowed_variance(blocks_a), with_borrowed_variance(blocks_b));
  std::vector<CautiousBlock> result;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    CautiousBlock block{raised[i], plain[i].welch.p};
    const int x = block.difference.x * size, y = block.difference.y * size;
    const double dof =
        largest_dof(a, b, block.difference.channel, {x, y, std::min(x + size, a.width), std::min(y + size, a.height)});
    WelchResult& w = block.difference.welch;
    if (dof < w.dof) {
      w.dof = dof;
      w.p = student_t_two_sided(w.t, dof);
    }
    result.push_back(block);
  }
  return result;
}

}  // namespace tyndall
