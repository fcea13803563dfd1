/// Film positions in a polygon, by the pixel's filter.
#pragma once

#include <vector>

#include "math/polygon.h"
#include "math/small_vector.h"
#include "transport/camera/pixel_filter.h"

namespace tyndall {

/// The filter's support as a grid of cells that are small enough for the filter to be about even in each. Positions are
/// pixels from the pixel's centre.
class FilterCells {
 public:
  explicit FilterCells(const FilterSampler& filter);

  Rectangle support() const { return {{x_.begin(), y_.begin()}, {x_.end(), y_.end()}}; }
  /// Integral of |filter| over the polygon, roughly: 1 for all of the support, 0 only where they do not overlap.
  double mass(const ConvexPolygon& polygon) const;

  struct Place {
    Point2 at;
    double pdf = 0;  ///< 1/pixels^2; 0: nothing was drawn
  };
  /// A place in the polygon and the support, about in proportion to |filter|.
  Place sample(const ConvexPolygon& polygon, Vec2 u) const;

 private:
  class Axis {
   public:
    Axis(const FilterSampler& filter, int axis);
    double begin() const { return ends_.front(); }
    double end() const { return ends_.back(); }
    /// The cells that a polygon within the support is in.
    struct Cells {
      std::size_t first, last;
    };
    Cells cells_of(const ConvexPolygon& polygon) const;
    ConvexPolygon cut(const ConvexPolygon& polygon, std::size_t cell) const;
    /// Of such cells, the area of the polygon in each, times the density of |filter| along the axis.
    using Masses = SmallVector<double, 32>;
    Masses masses(const ConvexPolygon& polygon, Cells cells) const;
    /// Leaves of the polygon what is in one of its cells, drawn by their masses with `u`, which is made anew of what is left of
    /// it. The probability; 0: the polygon is empty.
    double draw(ConvexPolygon& polygon, float& u) const;
    double density(std::size_t cell) const { return densities_[cell]; }

   private:
    int axis_;
    std::vector<double> ends_;       ///< of the cells, one more than them
    std::vector<double> densities_;  ///< of |filter|, > 0, 1/pixels
  };

  Axis x_, y_;
};

}  // namespace tyndall
