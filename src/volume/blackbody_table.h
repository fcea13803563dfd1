/// blackbody_rgb for the inner loop.
#pragma once

#include <vector>

#include "tyndall/math.h"

namespace tyndall {

/// Colour of a black body by table: Hermite cubics over ln T of rgb(T) exp(kScale / T), which hardly varies where
/// rgb itself falls by many orders of magnitude. Relative error below 1e-4 of the largest channel from kMin to kMax
/// kelvin; beyond kMax it asks blackbody_rgb.
class BlackbodyTable {
 public:
  static constexpr float kMin = 100;  ///< below it there is no emission, as in pbrt
  static constexpr float kMax = 20000;

  BlackbodyTable();
  Rgb operator()(float kelvin) const;

 private:
  static constexpr int kIntervals = 512;
  std::vector<Rgb> nodes_;
};

}  // namespace tyndall
