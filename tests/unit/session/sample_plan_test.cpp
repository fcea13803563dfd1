#include "session/sample_plan.h"

#include <doctest/doctest.h>

namespace tyndall {
namespace {

constexpr PixelBounds kCrop{5, 3, 43, 30};  // 6 x 4 blocks, those around in part

/// Of one noisy block.
std::vector<BlockNoise> noise_of(const BlockGrid& grid, std::size_t noisy) {
  std::vector<BlockNoise> blocks;
  for (std::size_t b = 0; b < grid.size(); ++b) {
    const auto pixels = static_cast<double>(grid.pixels(b).size());
    blocks.push_back({.error = (b == noisy ? 100 : 1) * pixels, .pixels = pixels});
  }
  return blocks;
}

SamplePlan decided(int most = 1 << 20) {
  SamplePlan plan(kCrop, most);
  plan.decide(32, noise_of(plan.grid(), 8));
  return plan;
}

TEST_CASE("blocks are cells of the frame, and each pixel of the crop lies in one") {
  const BlockGrid grid(kCrop);
  CHECK(grid.size() == 24);
  CHECK(grid.pixels(0) == PixelBounds{5, 3, 8, 8});
  CHECK(grid.pixels(23) == PixelBounds{40, 24, 43, 30});
  std::size_t pixels = 0;
  for (std::size_t b = 0; b < grid.size(); ++b) {
    const PixelBounds block = grid.pixels(b);
    pixels += block.size();
    CHECK(grid.index(block.x0, block.y0) == b);
    CHECK(grid.index(block.x1 - 1, block.y1 - 1) == b);
  }
  CHECK(pixels == kCrop.size());
}

TEST_CASE("all pixels have 32 samples before the first decision; rounds end at 48, 64, 96, 128 ... and at the most") {
  SamplePlan plan(kCrop, 200);
  for (const int n : {0, 1, 7, 32}) CHECK(plan.samples(3, n) == n);
  CHECK_FALSE(plan.is_open(31));
  CHECK(plan.is_open(32));
  std::vector<int> ends;
  for (int n = 0; n < 200; n = ends.back()) ends.push_back(plan.round_end(n));
  CHECK(ends == std::vector<int>{32, 48, 64, 96, 128, 192, 200});
  CHECK(plan.round_end(100) == 128);
  CHECK_FALSE(SamplePlan(kCrop, 32).is_open(32));
}

TEST_CASE("what is near the noisy block gets more, samples come in pairs, and their mean is that of the round") {
  const SamplePlan plan = decided();
  CHECK(plan.samples(9, 48) > 60);
  CHECK(plan.samples(23, 48) < 48);
  CHECK(plan.samples(23, 48) >= 32);
  CHECK(static_cast<double>(plan.total(48)) / static_cast<double>(kCrop.size()) == doctest::Approx(48).epsilon(0.02));
  for (std::size_t b = 0; b < plan.grid().size(); ++b) {
    CHECK(plan.samples(b, 32) == 32);
    for (int n = 32; n < 48; ++n) {
      CHECK(plan.samples(b, n) % 2 == 0);
      CHECK(plan.samples(b, n) <= plan.samples(b, n + 1));
    }
    CHECK(plan.samples(b, 1000) == plan.samples(b, 48));  // what comes is not decided
  }
  const SampleCounts counts = plan.counts(48);
  CHECK(counts.most() >= plan.samples(9, 48));
  CHECK(counts.of(kCrop.index(24, 8)) == plan.samples(9, 48));
  CHECK(counts.of(kCrop.index(42, 29)) == plan.samples(23, 48));
}

TEST_CASE("a block that takes longer gets less") {
  SamplePlan plan(kCrop, 1 << 20);
  for (std::size_t b = 0; b < plan.grid().size(); ++b) plan.add_work(b, (b == 9 ? 16 : 1) * plan.grid().pixels(b).size());
  plan.decide(32, noise_of(plan.grid(), 8));
  CHECK(plan.samples(9, 48) < decided().samples(9, 48));
}

TEST_CASE("at the most all pixels have as many") {
  SamplePlan plan = decided(64);
  plan.decide(48, noise_of(plan.grid(), 8));
  CHECK_FALSE(plan.is_open(64));
  CHECK(plan.counts(64).least() == 64);
  CHECK(plan.counts(64).most() == 64);
}

TEST_CASE("a plan goes on from its state") {
  SamplePlan plan = decided();
  plan.add_work(3, 1000);
  SamplePlan other(kCrop, 1 << 20);
  CHECK(plan.state().size() == plan.state_size());
  other.restore(plan.state());
  for (SamplePlan* p : {&plan, &other}) p->decide(48, noise_of(p->grid(), 3));
  for (std::size_t b = 0; b < plan.grid().size(); ++b) CHECK(plan.samples(b, 64) == other.samples(b, 64));
}

}  // namespace
}  // namespace tyndall
