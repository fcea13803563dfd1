/// The reconstruction filter, by importance sampling: a pixel owns its samples.
#pragma once

#include <vector>

#include "math/distribution.h"
#include "tyndall/scene.h"

namespace tyndall {

/// Value of the filter at offset (x, y) from the pixel's centre, not normalised. pbrt's formulas, all separable.
float filter_value(const PixelFilter& filter, Vec2 offset);

/// Draws offsets in proportion to |filter| and gives the weight that makes the mean of weight * value the filtered
/// pixel: 1 for filters that are nowhere negative, else +-W with W = (integral of |f|) / (integral of f)
/// [Ernst et al. 2006].
class FilterSampler {
 public:
  struct Offset {
    Vec2 p;  ///< pixels from the centre
    float weight;
    float pdf;  ///< 1/pixels^2
  };

  explicit FilterSampler(const PixelFilter& filter);

  Offset sample(Vec2 u) const;
  Offset at(Vec2 p) const;  ///< what sample() says of that offset; its pdf is 0 beyond the radius

  // Of one axis, 0 or 1, of which offsets are the product.
  float radius(int axis) const { return of(axis).radius; }
  float pdf(int axis, float x) const { return of(axis).at(x).pdf; }  ///< 1/pixels
  bool is_even(int axis) const { return of(axis).even; }             ///< the same density everywhere

 private:
  /// One dimension, tabulated: f is taken as constant within each of many equal bins.
  struct Axis {
    float radius;
    PiecewiseConstant1D distribution;  ///< of |f|
    std::vector<float> weights;        ///< +-W by bin
    bool even;

    Axis(const PixelFilter& filter, int axis);
    struct Place {
      float x, weight, pdf;
    };
    Place sample(float u) const;
    Place at(float x) const;
  };
  const Axis& of(int axis) const { return axis == 0 ? x_ : y_; }
  static Offset both(Axis::Place x, Axis::Place y);
  Axis x_, y_;
};

}  // namespace tyndall
