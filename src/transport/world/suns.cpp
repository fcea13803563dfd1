#include "transport/world/suns.h"

#include "volume/aureole.h"

namespace tyndall {
namespace {

/// Suns with less of the brightest one's light are not worth a look at the media before them.
constexpr float kLeastSun = 0.1f;

}  // namespace

Suns::Suns(const Lights& lights) : far_(lights.far().rest) {
  for (const FarCone& sun : lights.far().suns) {
    const bool seen =
        brightest_.size() < Aureole::kMostSources && (brightest_.empty() || sun.fluence >= kLeastSun * brightest_[0].fluence);
    if (seen) {
      brightest_.push_back(sun);
    } else {
      far_ += sun.fluence;
    }
  }
  if (!brightest_.empty() && !lights.near_box().empty())
    near_ = NearFluence(lights.near_box(), static_cast<float>(lights.near_power()));
}

}  // namespace tyndall
