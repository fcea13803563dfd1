/// What a few rays through a pixel see of emitters, before the first sample.
#pragma once

#include <cmath>
#include <cstddef>

#include "transport/pixel/emitter_image.h"
#include "transport/pixel/filter_cells.h"

namespace tyndall {

class EmitterLooks {
 public:
  /// At an emitter's image in a pixel.
  struct Met {
    std::size_t rays = 0, met = 0;  ///< rays that its image holds, and those of them that saw it
    double through = 0;             ///< share of the lens that its image there lets them through, on average

    bool partly() const { return met > 0 && met < rays; }
    /// What the emitter's light is weighed by in its share: with that of root mean square the estimate of what is found by such
    /// shares has the least variance, and the mean square of a yes or no is its chance, here by Jeffreys's prior.
    float weight() const { return std::sqrt((static_cast<float>(met) + 0.5f) / (static_cast<float>(rays) + 1)); }
  };

  /// What is referred to outlives this.
  EmitterLooks(const BuiltWorld& world, const FilterCells& cells) : world_(world), cells_(cells) {}

  /// At most `count`, > 0, in the pixel at `center`, at an image that its filter sees a part of.
  Met at(Point2 center, const EmitterImage& image, std::size_t count) const;
  /// Whether `side` x `side` places spread over the filter are about as bright.
  bool even(Point2 center, int side) const;

 private:
  const BuiltWorld& world_;
  const FilterCells& cells_;
};

}  // namespace tyndall
