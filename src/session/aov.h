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
  crypto_object,
  crypto_material,
  crypto_medium,
};

std::string name_of_aov(Aov aov);
/// Whether it is a layer of mattes (cryptomatte.h), of the same name.
constexpr bool is_matte(Aov aov) { return aov >= Aov::crypto_object && aov <= Aov::crypto_medium; }
/// AOVs by name, once each, in the order of aov_names(). Throws Error (usage) that lists the names for an unknown one.
std::vector<Aov> parse_aovs(const std::vector<std::string>& names);
/// And back: "Albedo,Z", whatever the order of `names`.
std::string aov_list(const std::vector<std::string>& names);

}  // namespace tyndall
