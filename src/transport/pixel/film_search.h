/// What is searched for on the film before the first sample.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "math/parallel.h"
#include "transport/world/built_world.h"

namespace tyndall {

struct FilmSearch {
  const BuiltWorld& world;
  const RenderSettings& settings;
  PixelBounds pixels;  ///< of the frame, that are rendered
  ThreadPool& pool;
  std::function<void()> alive;  ///< called repeatedly, by any thread, to show that a long search goes on
};

/// Whether settings let film positions be drawn by what is there, besides by the filter.
inline bool searches_film(const RenderSettings& s) {
  return s.joint == JointStrategy::points && s.lights != LightStrategy::exhaustive;
}

/// A filter of at most 4 pixels: wider ones hit what is small often enough, and show no peaks.
inline bool is_narrow(const PixelFilter& filter) { return std::max(filter.radius.x, filter.radius.y) <= 4; }

/// What `find`(light, found) adds of each light of the scene's own, among which are all point and spot lights, in their order;
/// blocks of them by the pool's threads.
template <typename Found, typename Find>
std::vector<Found> find_of_lights(const FilmSearch& search, const Find& find) {
  constexpr std::size_t kBlock = 1024;
  const std::size_t count = search.world.scene.lights.size();
  std::vector<std::vector<Found>> blocks((count + kBlock - 1) / kBlock);
  search.pool.for_each(blocks.size(), 1, [&](std::size_t block) {
    for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i)
      find(static_cast<LightId>(i), blocks[block]);
    search.alive();
  });
  std::vector<Found> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

}  // namespace tyndall
