#include "session/sample_plan.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace tyndall {
namespace {

constexpr PixelBounds kCrop{5, 3, 43, 30};  // 6 x 4 blocks, those around in part

/// Of means over `n` samples of each pixel: one block is noisier than the others.
std::vector<BlockNoise> noise_of(const BlockGrid& grid, std::size_t noisy, double n = 8) {
  std::vector<BlockNoise> blocks;
  for (std::size_t b = 0; b < grid.size(); ++b) {
    const auto pixels = static_cast<double>(grid.pixels(b).size());
    blocks.push_back({.error = (b == noisy ? 100 : 1) * pixels / n, .pixels = pixels});
  }
  return blocks;
}

constexpr int kNoEnd = 1 << 20;

SamplePlan decided() {
  SamplePlan plan(kCrop, kNoEnd);
  plan.decide(8, noise_of(plan.grid(), 8));
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

TEST_CASE(
    "all have 8 samples before the first decision; rounds end at 16, 24, 32, 48, 64, 96 ... and the last step of the most") {
  SamplePlan plan(kCrop, 203);
  for (const int n : {0, 1, 7, 8}) CHECK(plan.samples(3, n) == n);
  CHECK_FALSE(plan.is_open(7));
  CHECK(plan.is_open(8));
  std::vector<int> ends;
  for (int n = 0; n < 200; n = ends.back()) ends.push_back(plan.round_end(n));
  CHECK(ends == std::vector<int>{8, 16, 24, 32, 48, 64, 96, 128, 192, 200});
  CHECK(plan.round_end(100) == 128);
  CHECK_FALSE(SamplePlan(kCrop, 8).is_open(8));
  for (const int most : {1, 5, 8, 15}) CHECK(SamplePlan::last_end(most) == std::min(most, 8));
}

TEST_CASE("passes end within the first 8 samples anywhere, then at steps of 8, and with their round") {
  SamplePlan plan(kCrop, kNoEnd);
  CHECK(plan.pass_end(0, 3) == 3);
  CHECK(plan.pass_end(3, 20) == 8);
  CHECK(plan.pass_end(8, 1) == 16);
  CHECK(plan.pass_end(32, 9) == 48);
  CHECK(plan.pass_end(32, 100) == 48);
}

TEST_CASE("what is near the noisy block gets more, in pairs that count for as much together as everywhere") {
  const SamplePlan plan = decided();
  const std::size_t pixels = kCrop.size();
  CHECK(plan.samples(9, 16) > plan.samples(23, 16));
  CHECK(static_cast<double>(plan.total(16)) / static_cast<double>(pixels) == doctest::Approx(16).epsilon(0.1));
  CHECK(plan.total(16) <= 16 * pixels);
  for (std::size_t b = 0; b < plan.grid().size(); ++b) {
    CHECK(plan.samples(b, 8) == 8);
    const int in_round = plan.samples(b, 16) - 8;
    CHECK(in_round >= 2);
    CHECK(in_round % 2 == 0);
    CHECK(in_round * plan.share(b) == doctest::Approx(8));
    CHECK(plan.samples(b, 1000) == plan.samples(b, 16));  // what comes is not decided
  }
  const std::vector<int> counts = plan.counts(16);
  CHECK(counts[kCrop.index(24, 8)] == plan.samples(9, 16));
  CHECK(counts[kCrop.index(42, 29)] == plan.samples(23, 16));
  CHECK(plan.range(16).first == *std::min_element(counts.begin(), counts.end()));
  CHECK(plan.range(16).second == *std::max_element(counts.begin(), counts.end()));
}

TEST_CASE("samples go as the root of variance over work, whatever the mean has of the former by now") {
  SamplePlan plan(kCrop, kNoEnd);
  const auto work = [&](std::size_t b) { return (b % 6 < 3 ? 1 : 9) * plan.grid().pixels(b).size(); };
  for (std::size_t b = 0; b < plan.grid().size(); ++b) plan.add_work(b, 8 * work(b));
  std::vector<BlockNoise> noise = noise_of(plan.grid(), 99);
  plan.decide(8, noise);
  const auto first = [&](std::size_t b) { return plan.samples(b, 16) - 8; };
  CHECK(std::abs(first(0) - 3 * first(5)) <= 3);  // even numbers
  // Blocks that had more samples have a smaller error with the same variance, and are to have as many again.
  std::vector<int> taken;
  for (std::size_t b = 0; b < plan.grid().size(); ++b) {
    taken.push_back(first(b));
    noise[b].error = static_cast<double>(plan.grid().pixels(b).size()) * (8 + 64.0 / taken[b]) / (16 * 16);
    plan.add_work(b, static_cast<std::uint64_t>(taken[b]) * work(b));
  }
  plan.decide(16, noise);
  for (const std::size_t b : {0, 7, 11, 16}) CHECK(std::abs(plan.samples(b, 24) - plan.samples(b, 16) - taken[b]) <= 2);
}

TEST_CASE("a block gets a quarter of the mean at least, and at most three times what it has") {
  SamplePlan plan(kCrop, kNoEnd);
  std::vector<BlockNoise> noise = noise_of(plan.grid(), 8);
  for (BlockNoise& b : noise) b.error *= 1e-9;
  noise[8].error *= 1e18;
  plan.decide(8, noise);
  CHECK(plan.samples(23, 16) - 8 == 2);
  CHECK(plan.samples(8, 16) - 8 > 16);
  CHECK(plan.samples(8, 16) - 8 <= 24);
  for (int n = 16; n < 512; n = plan.round_end(n)) {
    plan.decide(n, noise);
    REQUIRE(plan.samples(23, plan.round_end(n)) - plan.samples(23, n) >= (plan.round_end(n) - n) / 4);
  }
}

TEST_CASE("all have 32 samples by the time that the render is expected to end") {
  for (const auto& [end, fewest] : {std::pair{32, 8}, {64, 4}, {256, 2}}) {
    std::vector<BlockNoise> noise = noise_of(BlockGrid(kCrop), 8);
    noise[8].error *= 1e6;
    SamplePlan plan(kCrop, kNoEnd, {.mean = mean_error(noise) * 8 / end});
    plan.decide(8, noise);
    CHECK(plan.samples(23, 16) - 8 == fewest);
  }
}

TEST_CASE("no pixel gets more than the most, however noisy, and each still has its part of every step") {
  SamplePlan plan(kCrop, 64);
  for (int n = 8; n < 64; n = plan.round_end(n)) {
    std::vector<BlockNoise> noise = noise_of(plan.grid(), 8);
    noise[8].error *= 1e6;
    plan.decide(n, noise);
    REQUIRE(plan.samples(8, plan.round_end(n)) > plan.samples(8, n));
    REQUIRE(plan.range(plan.round_end(n)).second <= 64);
  }
  CHECK_FALSE(plan.is_open(64));
}

constexpr PixelBounds kWhole{0, 0, 48, 32};  // 6 x 4 blocks

/// After 16 samples of each, in a round toward `goal`, with 64 times the variance in the left column.
SamplePlan uneven(const ErrorGoal& goal) {
  SamplePlan plan(kWhole, kNoEnd, goal);
  std::vector<BlockNoise> noise(24, {.error = 8, .pixels = 64});
  plan.decide(8, noise);
  for (std::size_t b = 0; b < noise.size(); ++b) noise[b].error = b % 6 == 0 ? 64 * 4 : 4;
  plan.decide(16, noise);
  return plan;
}
/// Relative variance of the mean in the left column, pooled.
double worst_of(const SamplePlan& plan) { return 43 * (16 + 64.0 / (plan.samples(6, 24) - 16)) / (24 * 24); }

TEST_CASE("a goal of the worst error that can be had is had; where that alone is missing the largest error is made least") {
  const SamplePlan without = uneven({});
  CHECK(without.samples(11, 24) - 16 == 4);
  const ErrorGoal can_be{.mean = 1e-9, .worst = 0.95 * worst_of(without)};
  const SamplePlan with = uneven(can_be);
  CHECK(worst_of(with) <= can_be.worst);
  CHECK(with.total(24) <= 24 * kWhole.size());
  for (const ErrorGoal& goal : {ErrorGoal{.worst = 1e-9}, {.mean = 1e-9, .worst = 1e-9}}) {
    const SamplePlan plan = uneven(goal);
    CHECK(worst_of(plan) < worst_of(without));
    CHECK(plan.samples(11, 24) - 16 == 2);
  }
}

TEST_CASE("a plan goes on from its state") {
  SamplePlan plan = decided();
  plan.add_work(3, 1000);
  SamplePlan other(kCrop, kNoEnd);
  CHECK(plan.state().size() == plan.state_size());
  other.restore(plan.state());
  for (SamplePlan* p : {&plan, &other}) p->decide(16, noise_of(p->grid(), 3));
  for (std::size_t b = 0; b < plan.grid().size(); ++b) CHECK(plan.samples(b, 24) == other.samples(b, 24));
  CHECK(plan.samples(3, 24) != plan.samples(20, 24));
}

}  // namespace
}  // namespace tyndall
