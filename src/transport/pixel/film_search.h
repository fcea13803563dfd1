/// What is searched for on the film before the first sample.
#pragma once

#include <functional>

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

}  // namespace tyndall
