/// Lights that are somewhere, one after the other.
#pragma once

#include <cstddef>

#include "light/lights.h"
#include "transport/world/volume_lights.h"

namespace tyndall {

/// Calls f(id, place, n) for lights with a place; of more than `most` for one in n, which stands for so many. Not for media:
/// they emit by themselves, whether they are sampled as lights or not.
template <typename F>
void for_each_near_light(const Lights& lights, const VolumeLights& media, std::size_t most, const F& f) {
  const std::size_t step = lights.size() / most + 1;
  for (std::size_t i = 0; i < lights.size(); i += step) {
    const auto id = static_cast<LightId>(i);
    if (media.holds(id)) continue;
    const LightPlace place = lights.place(id);
    if (place.center) f(id, place, step);
  }
}

}  // namespace tyndall
