/// How much memory a scene will take, before it is taken.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tyndall/render.h"

namespace tyndall {

/// Bytes by what takes them. Upper estimates from counts: within a factor of two of what a build and a render then hold.
/// Volumes in files are not among them; their size is known when they are opened (MediumBuildOptions::most_memory).
struct MemoryPlan {
  std::size_t in_use = 0;  ///< by the process, the scene as read included
  std::vector<std::pair<std::string, std::size_t>> parts;

  std::size_t total() const;
  std::string str() const;  ///< "film 0.5, geometry 2.1 GB"
};

/// Of a pixel of the scene's film, without KeyedSums, and of its image, without mattes: a few more at most.
struct FilmNumbers {
  std::size_t sums, channels;
};
FilmNumbers film_numbers(const Scene& scene);

/// `lights`: the strategies that it is built for. Sizes of images are taken from `kept`.
MemoryPlan plan_memory(const Scene& scene, std::span<const LightStrategy> lights, KeptFiles* kept = nullptr);

/// Throws Error (scene) with the estimate when the plan exceeds `limit` bytes.
void require_memory(const MemoryPlan& plan, const Scene& scene, std::size_t limit);

/// What volumes in files may take: `limit` less the plan, at least 0.
std::size_t left_for_volumes(const MemoryPlan& plan, std::size_t limit);

}  // namespace tyndall
