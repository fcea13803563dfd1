/// How much memory a scene will take once it is built, before it is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "tyndall/scene.h"
#include "tyndall/settings.h"

namespace tyndall {

class KeptFiles;  // tyndall/frames.h

/// Bytes, from counts that may be beyond 64 bits.
class ByteCount {
 public:
  void add(double count, double bytes) { bytes_ += count * bytes; }
  std::size_t bytes() const { return static_cast<std::size_t>(std::min(bytes_, 1e18)); }

 private:
  double bytes_ = 0;
};

/// Pixels of the frame that are rendered.
double pixels_of(const Scene& scene);

/// Bytes of a BuiltWorld and of what is searched for on the film beforehand: upper estimates, within a factor of two. Volumes
/// in files are not among them.
struct PlannedMemory {
  std::size_t on_film, geometry, lights, textures, volumes;
};
/// `lights`: the strategies that the world is built for. Sizes of images are taken from `kept`.
PlannedMemory plan_built_world(const Scene& scene, std::span<const LightStrategy> lights, KeptFiles* kept = nullptr);

}  // namespace tyndall
