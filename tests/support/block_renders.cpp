#include "support/block_renders.h"

#include <doctest/doctest.h>

#include "support/block_image.h"
#include "support/sanitized.h"

namespace tyndall::test {

BlockRenders block_renders(Subject subject, int side, int spp, std::uint64_t seed) {
  const int renders = fewer(24);
  MeanImageBuilder blocks, pixels;
  for (int i = 0; i < renders; ++i) {
    const Image image = subject.render(spp, seed + static_cast<std::uint64_t>(i));
    pixels.add(image);
    blocks.add(block_image(image, side));
  }
  CHECK_MESSAGE(subject.faults().empty(), subject.faults());
  BlockRenders result{blocks.result(), 0};
  const MeanImage of_pixels = pixels.result();
  for (const Estimate& e : of_pixels.channels[1]) result.pixel_variance += e.variance;
  return result;
}

}  // namespace tyndall::test
