#include "session/allocation.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

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
  std::vector<BlockNoise> blocks(20, {.error = 6.4, .pixels = 64});
  blocks[7] = {.error = 64 * 2.05, .pixels = 64};
  CHECK(mean_error(blocks) == doctest::Approx((19 * 0.1 + 2.05) / 20));
  CHECK(worst_error(blocks, 5) == doctest::Approx((4 * 2.05 + 12 * 0.1) / 16));
  const std::vector<double> around = errors_around(blocks, 5);
  REQUIRE(around.size() == 20);
  CHECK(around[7] == doctest::Approx(worst_error(blocks, 5)));
  CHECK(around[6] == doctest::Approx((2 * 2.05 + 14 * 0.1) / 16));
  CHECK(around[19] == doctest::Approx(0.1));
}

/// Of all samples, over that of as many everywhere.
double work_taken(const std::vector<BlockShare>& blocks, const std::vector<int>& samples, int everywhere) {
  double taken = 0, budget = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    taken += blocks[i].work * samples[i];
    budget += blocks[i].work * everywhere;
  }
  return taken / budget;
}

TEST_CASE("samples are even, in proportion to what is asked for, within bounds and the work of as many everywhere") {
  std::vector<BlockShare> blocks;
  for (int i = 0; i < 400; ++i) {
    blocks.push_back({.amount = std::exp2(0.01 * (i * 7 % 400)), .work = 1.0 + i % 3, .least = 2, .most = i == 7 ? 8 : 64});
  }
  for (const int everywhere : {8, 16}) {
    const std::vector<int> samples = allot(blocks, everywhere);
    CHECK(work_taken(blocks, samples, everywhere) <= 1);
    CHECK(work_taken(blocks, samples, everywhere) > 0.99);
    double low = 0, high = kInfinity;  // between which the proportion lies
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      REQUIRE(samples[i] % 2 == 0);
      REQUIRE(samples[i] >= 2);
      REQUIRE(samples[i] <= blocks[i].most);
      if (samples[i] > 2) low = std::max(low, (samples[i] - 1.01) / blocks[i].amount);
      if (samples[i] < blocks[i].most) high = std::min(high, (samples[i] + 1.01) / blocks[i].amount);
    }
    CHECK(low <= high);
  }
}

TEST_CASE("all blocks alike get as many as everywhere, whatever is asked for; the least is had though it is too much work") {
  for (const double amount : {1e-6, 1.0, 1e20})
    CHECK(allot(std::vector<BlockShare>(9, {.amount = amount, .work = 3, .least = 2, .most = 64}), 8) ==
          std::vector<int>(9, 8));
  CHECK(allot(std::vector<BlockShare>(9, {.amount = 1, .work = 3, .least = 16, .most = 64}), 8) == std::vector<int>(9, 16));
}

}  // namespace
}  // namespace tyndall
