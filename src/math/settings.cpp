#include "tyndall/settings.h"

#include <array>
#include <cstddef>
#include <utility>

namespace tyndall {
namespace {

// Registering a strategy is adding a row to its table; an axis of strategies, to the list at the end.
template <typename Strategy, std::size_t N>
using Table = std::array<std::pair<std::string_view, Strategy>, N>;

constexpr Table<LightStrategy, 8> kLights{{
    {"uniform", LightStrategy::uniform},
    {"power", LightStrategy::power},
    {"exhaustive", LightStrategy::exhaustive},
    {"tree", LightStrategy::tree},
    {"tree-binary", LightStrategy::tree_binary},
    {"cycles-rule", LightStrategy::cycles_rule},
    {"lightcuts", LightStrategy::lightcuts},
    {"cells", LightStrategy::cells},
}};
constexpr Table<MediaStrategy, 5> kMedia{{
    {"auto", MediaStrategy::automatic},
    {"vertex", MediaStrategy::vertex},
    {"closest", MediaStrategy::closest},
    {"integral", MediaStrategy::integral},
    {"product", MediaStrategy::product},
}};
constexpr Table<DistanceStrategy, 5> kDistances{{
    {"auto", DistanceStrategy::automatic},
    {"tracking", DistanceStrategy::tracking},
    {"equiangular", DistanceStrategy::equiangular},
    {"both", DistanceStrategy::both},
    {"profile", DistanceStrategy::profile},
}};
constexpr Table<EmissionStrategy, 3> kEmissions{{
    {"auto", EmissionStrategy::automatic},
    {"paths", EmissionStrategy::paths},
    {"lights", EmissionStrategy::lights},
}};
constexpr Table<GuidingStrategy, 3> kGuidings{{
    {"auto", GuidingStrategy::automatic},
    {"off", GuidingStrategy::off},
    {"media", GuidingStrategy::media},
}};
constexpr Table<JointStrategy, 3> kJoints{{
    {"auto", JointStrategy::automatic},
    {"off", JointStrategy::off},
    {"points", JointStrategy::points},
}};
constexpr Table<ReuseStrategy, 3> kReuses{{
    {"auto", ReuseStrategy::automatic},
    {"off", ReuseStrategy::off},
    {"pixels", ReuseStrategy::pixels},
}};
constexpr Table<BudgetStrategy, 3> kBudgets{{
    {"auto", BudgetStrategy::automatic},
    {"fixed", BudgetStrategy::fixed},
    {"measured", BudgetStrategy::measured},
}};
constexpr Table<TransmittanceStrategy, 4> kTransmittances{{
    {"residual", TransmittanceStrategy::residual},
    {"ratio", TransmittanceStrategy::ratio},
    {"delta", TransmittanceStrategy::delta},
    {"raymarch", TransmittanceStrategy::raymarch},
}};
constexpr std::array<std::string_view, 17> kAovs{"Albedo",
                                                 "N",
                                                 "P",
                                                 "Z",
                                                 "Zvol",
                                                 "Variance",
                                                 "SampleCount",
                                                 "Transmittance",
                                                 "SurfaceDirect",
                                                 "SurfaceIndirect",
                                                 "VolumeDirect",
                                                 "VolumeIndirect",
                                                 "Emission",
                                                 "Replicate",
                                                 "CryptoObject",
                                                 "CryptoMaterial",
                                                 "CryptoMedium"};

template <typename Table, typename Strategy>
std::string_view find_name(const Table& table, Strategy wanted) {
  for (const auto& [name, strategy] : table) {
    if (strategy == wanted) return name;
  }
  return {};
}

/// The axis of one table and the setting that it is about.
template <const auto& table, auto member>
StrategyAxis axis(std::string_view option, std::string_view about) {
  StrategyAxis axis;
  axis.option = option;
  axis.about = about;
  for (const auto& row : table) axis.names.push_back(row.first);
  axis.set = [](RenderSettings& settings, std::string_view wanted) {
    for (const auto& [name, strategy] : table) {
      if (name != wanted) continue;
      settings.*member = strategy;
      return true;
    }
    return false;
  };
  axis.get = [](const RenderSettings& settings) { return find_name(table, settings.*member); };
  return axis;
}

}  // namespace

const std::vector<StrategyAxis>& strategy_axes() {
  static const std::vector<StrategyAxis> axes{
      axis<kLights, &RenderSettings::lights>("lights", "how a light is chosen"),
      axis<kMedia, &RenderSettings::media>("media", "what stands for a segment of medium when its light is chosen"),
      axis<kDistances, &RenderSettings::distance>("distance", "how the distance along a segment is sampled"),
      axis<kEmissions, &RenderSettings::emission>("emission", "how volume emission is found"),
      axis<kGuidings, &RenderSettings::guiding>(
          "guiding",
          "whether the surface that a path meets first also sends it toward grids and clouds, and collisions toward suns"),
      axis<kJoints, &RenderSettings::joint>("joint",
                                            "whether collisions in media and pixels also draw rays close to point and spot "
                                            "lights, and pixels toward small emissive surfaces"),
      axis<kReuses, &RenderSettings::reuse>("reuse",
                                            "whether neighbouring pixels share what paths find beyond the first bounce"),
      axis<kBudgets, &RenderSettings::budget>(
          "budget",
          "how many lights are asked at a path's first vertex and along its first segment, and what pays of "
          "--media, --emission, --guiding and --reuse where they are auto"),
      axis<kTransmittances, &RenderSettings::transmittance>("transmittance", "estimator along shadow rays"),
  };
  return axes;
}

std::string_view name_of(LightStrategy strategy) { return find_name(kLights, strategy); }
std::string_view name_of(TransmittanceStrategy strategy) { return find_name(kTransmittances, strategy); }
std::vector<std::string_view> aov_names() { return {kAovs.begin(), kAovs.end()}; }

}  // namespace tyndall
