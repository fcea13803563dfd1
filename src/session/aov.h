/// Channels that are asked for beside R G B A.
#pragma once

#include <string>
#include <vector>

namespace tyndall {

enum class Aov {
  albedo,
  n,
  p,
  z,
  z_volume,
  variance,
  sample_count,
  transmittance,
  surface_direct,
  surface_indirect,
  volume_direct,
  volume_indirect,
  emission,
  replicate,
};

std::string name_of_aov(Aov aov);
/// AOVs by name, once each, in the order of aov_names(). Throws Error (usage) that lists the names for an unknown one.
std::vector<Aov> parse_aovs(const std::vector<std::string>& names);
/// And back: "Albedo,Z", whatever the order of `names`.
std::string aov_list(const std::vector<std::string>& names);

}  // namespace tyndall
