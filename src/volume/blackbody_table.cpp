#include "volume/blackbody_table.h"

#include <algorithm>
#include <cmath>

#include "tyndall/color.h"

namespace tyndall {
namespace {

/// hc / (k_B * 760 nm): near the red end of what the eye sees.
constexpr float kScale = 18930;

/// Logarithm of a float that is surely normal, by its bits; 2e-7 absolute is all the table needs.
float position(float kelvin) { return std::log(kelvin / BlackbodyTable::kMin); }

}  // namespace

BlackbodyTable::BlackbodyTable() {
  nodes_.resize(kIntervals + 3);
  const float step = position(kMax) / kIntervals;
  auto node = nodes_.begin();
  for (int i = -1; i <= kIntervals + 1; ++i) {
    const float kelvin = kMin * std::exp(static_cast<float>(i) * step);
    // exp(kScale / T) overflows where rgb underflows: nothing to see there.
    const float lift = kScale / kelvin;
    *node++ = lift < 80 ? blackbody_rgb(kelvin) * std::exp(lift) : Rgb{};
  }
}

Rgb BlackbodyTable::operator()(float kelvin) const {
  if (!(kelvin > kMin)) return {};
  if (kelvin >= kMax) return blackbody_rgb(kelvin);
  const float x = position(kelvin) * (kIntervals / position(kMax));
  const int i = std::min(static_cast<int>(x), kIntervals - 1);
  const float f = x - static_cast<float>(i);

  // Catmull-Rom: the weights of four equally spaced nodes around the interval.
  const float w0 = f * (f * (1 - 0.5f * f) - 0.5f);
  const float w1 = 1 + f * f * (1.5f * f - 2.5f);
  const float w2 = f * (0.5f + f * (2 - 1.5f * f));
  const float w3 = f * f * (0.5f * f - 0.5f);
  const Rgb* n = nodes_.data() + i;
  return (n[0] * w0 + n[1] * w1 + n[2] * w2 + n[3] * w3) * std::exp(-kScale / kelvin);
}

}  // namespace tyndall
