/// All lights examined, in blocks by the pool's threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "light/query.h"
#include "math/parallel.h"

namespace tyndall {

/// What `look` finds of lights 0 to `count` - 1, in their order: it returns a std::optional.
template <typename Look>
auto gather_lights(std::size_t count, ThreadPool& pool, const Look& look) {
  using Found = typename decltype(look(LightId{}))::value_type;
  constexpr std::size_t kBlock = 4096;
  std::vector<std::vector<Found>> blocks((count + kBlock - 1) / kBlock);
  pool.for_each(blocks.size(), 1, [&](std::size_t block) {
    for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
      if (auto found = look(static_cast<LightId>(i))) blocks[block].push_back(*found);
    }
  });
  std::vector<Found> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

}  // namespace tyndall
