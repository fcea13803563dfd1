#include "session/allocation.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tyndall {
namespace {

/// 5 x 4 blocks of 64 pixels with 100 samples each; all have the same error, so that pooling changes nothing.
std::vector<BlockNoise> even_blocks() {
  return std::vector<BlockNoise>(20, {.error = 64, .pixels = 64, .work = 64, .samples = 100});
}

double mean_over_pixels(const std::vector<BlockNoise>& blocks, const std::vector<int>& samples) {
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) sum += blocks[i].pixels * samples[i], pixels += blocks[i].pixels;
  return sum / pixels;
}

TEST_CASE("the error of a block is pooled with that of the blocks around it, at the border with fewer") {
  std::vector<BlockNoise> blocks(20, {.error = 0, .pixels = 64});
  blocks[7] = {.error = 1600, .pixels = 64};  // column 2, row 1
  const auto error = [&](int at) { return pooled_error(blocks, 5, at); };
  CHECK(error(7) == doctest::Approx(25.0 * 4 / 16));
  CHECK(error(6) == doctest::Approx(25.0 * 2 / 16));
  CHECK(error(12) == doctest::Approx(25.0 * 2 / 16));
  CHECK(error(11) == doctest::Approx(25.0 * 1 / 16));
  CHECK(error(2) == doctest::Approx(25.0 * 2 / 12));  // the row above is not there
  CHECK(error(9) == 0);
  blocks[6].pixels = 16;  // cut off by a crop: counts for less
  CHECK(error(7) == doctest::Approx(1600.0 * 4 / (64 * 14 + 16 * 2)));
}

TEST_CASE("the error of a picture is the mean over pixels, its worst part a block with those around it") {
  std::vector<BlockNoise> blocks(20, {.error = 64, .pixels = 64, .samples = 10});
  blocks[7] = {.error = 64 * 41, .pixels = 64, .samples = 20};
  CHECK(mean_error(blocks) == doctest::Approx((19 * 0.1 + 41.0 / 20) / 20));
  CHECK(worst_error(blocks, 5) == doctest::Approx((4 * 41.0 / 20 + 12 * 0.1) / 16));
  const std::vector<double> around = errors_around(blocks, 5);
  REQUIRE(around.size() == 20);
  CHECK(around[7] == doctest::Approx(worst_error(blocks, 5)));
  CHECK(around[6] == doctest::Approx((2 * 41.0 / 20 + 14 * 0.1) / 16));
  CHECK(around[19] == doctest::Approx(0.1));
}

TEST_CASE("samples go as the root of error over work, and no other division has less error for its work") {
  std::vector<BlockNoise> blocks = even_blocks();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].samples = 32;
    blocks[i].work = i % 5 == 4 ? 4 * 64 : 64;  // the right column takes four times as long
  }
  const std::vector<int> samples = allot(blocks, 5, {96, 1 << 20});
  CHECK(samples[4] * 2 == doctest::Approx(samples[0]).epsilon(0.04));
  CHECK(samples[0] == samples[1]);
  const auto error_times_work = [&](const std::vector<int>& n) {
    double error = 0, work = 0;
    for (std::size_t i = 0; i < n.size(); ++i) error += 1.0 / n[i], work += blocks[i].work * n[i];
    return error * work;
  };
  const double best = error_times_work(samples);
  for (const int step : {-12, 12}) {
    std::vector<int> other = samples;
    for (std::size_t i = 4; i < other.size(); i += 5) other[i] += step;
    CHECK(error_times_work(other) > best);
  }
}

TEST_CASE("the mean is that of the budget, whatever the noise") {
  std::vector<BlockNoise> blocks = even_blocks();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].error = std::exp2(static_cast<double>(i * 7 % 20));
    blocks[i].pixels = i % 5 == 4 ? 16 : 64;
  }
  for (const double mean : {110.0, 128.0, 192.0}) {
    const std::vector<int> samples = allot(blocks, 5, {mean, 1 << 30});
    CHECK(mean_over_pixels(blocks, samples) == doctest::Approx(mean).epsilon(0.01));
    CHECK(std::all_of(samples.begin(), samples.end(), [](int n) { return n % 2 == 0; }));
  }
}

TEST_CASE("no block gets less than it has or a quarter of the mean, more than four times what it has, or more than the most") {
  std::vector<BlockNoise> blocks = even_blocks();
  blocks[0].error = 1e9;
  blocks[19].error = 0;
  std::vector<int> samples = allot(blocks, 5, {192, 1 << 30});
  CHECK(samples[1] == 400);
  samples = allot(blocks, 5, {128, 1 << 30});
  CHECK(*std::min_element(samples.begin(), samples.end()) == 100);
  samples = allot(blocks, 5, {128, 300});
  CHECK(*std::max_element(samples.begin(), samples.end()) == 300);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].samples = i < 10 ? 400 : 100;
    blocks[i].error = i < 10 ? 64 : 0;
  }
  samples = allot(blocks, 5, {600, 1 << 30});
  CHECK(samples[19] == 150);  // no noise has been seen there, nor around
  CHECK(mean_over_pixels(blocks, allot(blocks, 5, {900, 900})) <= 900);
}

TEST_CASE("where nothing is noisy, or all is equally, all get the same") {
  for (const double error : {0.0, 1.0, 1e30}) {
    std::vector<BlockNoise> blocks = even_blocks();
    for (BlockNoise& b : blocks) b.error = error;
    CHECK(allot(blocks, 5, {192, 1 << 30}) == std::vector<int>(20, 192));
    CHECK(allot(blocks, 5, {192, 1 << 30, {.mean = 1, .worst = 1e-3}}) == std::vector<int>(20, 192));
  }
}

/// The left two columns have nine times the error of the others, which the middle one is pooled between.
std::vector<BlockNoise> uneven_blocks() {
  std::vector<BlockNoise> blocks = even_blocks();
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].error = i % 5 < 2 ? 9 * 64 : 64;
  return blocks;
}

/// Of a sample in a block over the samples it gets, as the goal of the worst error is held against it.
double worst_after(const std::vector<BlockNoise>& blocks, const std::vector<int>& samples) {
  double worst = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    worst = std::max(worst, pooled_error(blocks, 5, static_cast<int>(i)) / samples[i]);
  return worst;
}

TEST_CASE("a goal of the worst error that can be had is had, and what is left goes where it makes the mean least") {
  const std::vector<BlockNoise> blocks = uneven_blocks();
  const ErrorGoal goal{.mean = 1e-6, .worst = 9.0 / 380};
  const std::vector<int> samples = allot(blocks, 5, {220, 1 << 30, goal}), without = allot(blocks, 5, {220, 1 << 30});
  CHECK(worst_after(blocks, samples) <= goal.worst * 1.01);  // numbers are even
  CHECK(worst_after(blocks, without) > goal.worst * 1.05);   // else the test shows nothing
  CHECK(samples[0] == 380);
  CHECK(samples[4] == samples[9]);
  CHECK(mean_over_pixels(blocks, samples) == doctest::Approx(220).epsilon(0.01));
  // Of those above their least, the root of the error decides as ever: columns 2 and 3 are pooled with both sides.
  const double middle = pooled_error(blocks, 5, 7), right = pooled_error(blocks, 5, 9);
  CHECK(double(samples[7]) / samples[9] == doctest::Approx(std::sqrt(middle / right)).epsilon(0.03));
}

TEST_CASE("where the goal of the worst error alone is missing, or cannot be had yet, the largest error is made least") {
  const std::vector<BlockNoise> blocks = uneven_blocks();
  for (const ErrorGoal& goal : {ErrorGoal{.worst = 9.0 / 350}, ErrorGoal{.mean = 1e-6, .worst = 1e-6}}) {
    const std::vector<int> samples = allot(blocks, 5, {180, 1 << 30, goal});
    CHECK(mean_over_pixels(blocks, samples) == doctest::Approx(180).epsilon(0.01));
    CHECK(worst_after(blocks, samples) < worst_after(blocks, allot(blocks, 5, {180, 1 << 30})));
    for (std::size_t i = 0; i < blocks.size(); ++i)
      CHECK((samples[i] == 100 || pooled_error(blocks, 5, static_cast<int>(i)) / samples[i] ==
                                      doctest::Approx(worst_after(blocks, samples)).epsilon(0.02)));
  }
}

TEST_CASE("what all may have at most is what all get in the end") {
  std::vector<BlockNoise> blocks = even_blocks();
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].error = static_cast<double>(i * i);
  CHECK(allot(blocks, 5, {256, 256}) == std::vector<int>(20, 256));
}

}  // namespace
}  // namespace tyndall
