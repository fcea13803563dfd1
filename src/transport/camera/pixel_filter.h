/// The reconstruction filter, by importance sampling: a pixel owns its samples.
#pragma once

#include <array>

#include "math/distribution.h"
#include "tyndall/scene.h"

namespace tyndall {

/// Value of the filter at offset (x, y) from the pixel's centre, not normalised. pbrt's formulas, all separable.
float filter_value(const PixelFilter& filter, Vec2 offset);

/// Draws offsets in proportion to the filter, and gives the weight that makes the mean of weight * value the filtered pixel: 1
/// for filters that are nowhere negative. Of others an eighth of the offsets is drawn where f < 0 and the rest where f > 0,
/// each in proportion to |f| [Ernst et al. 2006 draw from all of |f|]: which of them is decided by the first eighth of u.x, so
/// that of eight stratified samples just one is negative and the weights' mean has no noise of its own.
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
  float pdf(int axis, float x) const { return of(axis).at(x).pdf; }  ///< of |filter|, 1/pixels
  bool is_even(int axis) const { return of(axis).even; }             ///< the same density everywhere

 private:
  /// One dimension, tabulated: f is taken as constant within each of many equal bins.
  struct Axis {
    float radius;
    PiecewiseConstant1D magnitude;             ///< |f|
    std::array<PiecewiseConstant1D, 2> lobes;  ///< of f > 0 and f < 0; empty where f is nowhere negative
    bool even;

    Axis(const PixelFilter& filter, int axis);
    double mass(bool below) const;  ///< sum over the bins where f < 0, or those where it is not, of |f|
    const PiecewiseConstant1D& part(bool below) const { return lobes[0].size() == 0 ? magnitude : lobes[below ? 1 : 0]; }
    struct Place {
      float x;
      float pdf;  ///< of |f|
      bool below;
    };
    Place sample(float u, bool below) const;
    Place at(float x) const;
  };
  /// Where f > 0, or where f < 0: the axes' signs agree there or differ, either of which can be in two ways.
  struct Sign {
    float share;  ///< of the samples
    float first;  ///< of these, with the first axis above 0
    float weight;
    float density;  ///< of a sample, over that of |f|
  };
  Sign of_sign(bool below, float share) const;
  const Axis& of(int axis) const { return axis == 0 ? x_ : y_; }
  Offset offset(const Axis::Place& x, const Axis::Place& y) const;
  Axis x_, y_;
  std::array<Sign, 2> signs_;  ///< f > 0, f < 0
};

}  // namespace tyndall
