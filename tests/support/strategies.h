/// Every strategy of a kind that there is: what compares them all goes through here, so that a new one is compared at once.
#pragma once

#include <stdexcept>
#include <string_view>
#include <vector>

#include "tyndall/settings.h"

namespace tyndall::test {

/// In the order of the command line's help; `option` is its name there, `member` what it sets.
template <typename Strategy>
std::vector<Strategy> every(std::string_view option, Strategy RenderSettings::*member) {
  std::vector<Strategy> all;
  for (const StrategyAxis& axis : strategy_axes()) {
    if (axis.option != option) continue;
    for (const std::string_view name : axis.names) {
      RenderSettings settings;
      axis.set(settings, name);
      all.push_back(settings.*member);
    }
  }
  if (all.empty()) throw std::logic_error("no option has this name");
  return all;
}

inline std::vector<LightStrategy> every_lights() { return every("lights", &RenderSettings::lights); }
inline std::vector<MediaStrategy> every_media() { return every("media", &RenderSettings::media); }
inline std::vector<DistanceStrategy> every_distance() { return every("distance", &RenderSettings::distance); }
inline std::vector<TransmittanceStrategy> every_transmittance() {
  return every("transmittance", &RenderSettings::transmittance);
}
inline std::vector<GuidingStrategy> every_guiding() { return every("guiding", &RenderSettings::guiding); }
inline std::vector<JointStrategy> every_joint() { return every("joint", &RenderSettings::joint); }

}  // namespace tyndall::test
