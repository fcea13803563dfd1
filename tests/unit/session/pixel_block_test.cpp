#include "session/pixel_block.h"

#include <doctest/doctest.h>

#include <set>
#include <vector>

using namespace tyndall;

namespace {

std::vector<std::pair<int, int>> places(const PixelBlock& block) {
  std::vector<std::pair<int, int>> all;
  for (const PixelPlace p : block.pixels()) all.emplace_back(p.x, p.y);
  return all;
}

}  // namespace

TEST_CASE("a block holds the pixels of its cell that lie within the bounds, each once, in any order") {
  PixelBlock block(19, 10, {0, 0, 21, 40});
  const std::set<std::pair<int, int>> before = [&] {
    const auto all = places(block);
    return std::set<std::pair<int, int>>(all.begin(), all.end());
  }();
  CHECK(before.size() == 5 * 8);
  CHECK(before.contains({16, 8}));
  CHECK(before.contains({20, 15}));
  block.shuffle(7, 3);
  const auto shuffled = places(block);
  CHECK(std::set<std::pair<int, int>>(shuffled.begin(), shuffled.end()) == before);
}

TEST_CASE("the order of a sample does not depend on the samples before it; it differs between samples, blocks and seeds") {
  const PixelBounds frame{0, 0, 64, 64};
  const auto order = [&](int x, std::uint64_t seed, std::vector<int> samples) {
    PixelBlock block(x, 8, frame);
    for (const int s : samples) block.shuffle(seed, s);
    auto all = places(block);
    for (auto& p : all) p.first %= PixelBlock::kSide;
    return all;
  };
  CHECK(order(8, 1, {5}) == order(8, 1, {0, 1, 2, 3, 4, 5}));
  CHECK(order(8, 1, {5}) != order(8, 1, {6}));
  CHECK(order(8, 1, {5}) != order(16, 1, {5}));
  CHECK(order(8, 1, {5}) != order(8, 2, {5}));
}
