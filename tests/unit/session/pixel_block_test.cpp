#include "session/pixel_block.h"

#include <doctest/doctest.h>

#include <set>
#include <vector>

#include "transport/sharing/suffix_reuse.h"

using namespace tyndall;

namespace {

std::vector<std::pair<int, int>> places(const PixelBlock& block) {
  std::vector<std::pair<int, int>> all;
  for (const PixelPlace p : block.pixels()) all.emplace_back(p.x, p.y);
  return all;
}

}  // namespace

TEST_CASE("a block holds the pixels of its cell that lie within the bounds, each once") {
  const PixelBlock block(19, 10, {0, 0, 18, 40});
  const auto all = places(block);
  CHECK(all.size() == 2 * 8);
  CHECK(std::set<std::pair<int, int>>(all.begin(), all.end()).size() == all.size());
  for (const auto& [x, y] : all) {
    CHECK((x == 16 || x == 17));
    CHECK(y >= 8);
    CHECK(y < 16);
  }
}

TEST_CASE("no block holds more than can share") { CHECK(PixelBlock(0, 0, {0, 0, 64, 64}).pixels().size() == kMostSharing); }
